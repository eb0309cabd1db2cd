// The tools that change the corrections. A tool starts a gesture: {move, end, cancel}.

const NEAR_PX = 0.25; // closer samples of the pointer are ignored

function freeLine(kind) {
  return (b, start) => {
    const before = b.doc.overlay.slice();
    const width = b.widths[kind];
    let last = start;
    let dirty = noBox();
    const add = (points) => {
      const box = applyStroke(b.overlay, { kind, width, points });
      dirty = unionBox(dirty, box);
      refreshMask(b, box);
    };
    add([start]);
    return {
      move(point) {
        if (Math.hypot(point[0] - last[0], point[1] - last[1]) < NEAR_PX) return;
        add([last, point]);
        last = point;
      },
      end: () => addStroke(b, before, dirty),
      cancel: () => restore(b, before, dirty),
    };
  };
}

function twoPoints(kind) {
  return (b, start) => {
    const before = b.doc.overlay.slice();
    const width = b.widths[kind] ?? 1;
    let end = start;
    let dirty = noBox();
    const cancel = () => restore(b, before, dirty);
    return {
      move(point, event) {
        cancel();
        end = kind === "line" && isStraight(b, event) ? turnedTo45(start, point) : point;
        dirty = applyStroke(b.overlay, { kind, width, points: [start, end] });
        refreshMask(b, dirty);
      },
      end() {
        // A click without a drag does not define the other end.
        if (Math.hypot(end[0] - start[0], end[1] - start[1]) * b.camera.scale < 3) return cancel();
        addStroke(b, before, dirty);
      },
      cancel,
      get extent() {
        return isEmptyBox(dirty) ? null : [start, end];
      },
    };
  };
}

function restore(b, before, box) {
  if (isEmptyBox(box)) return;
  for (let row = box.y0; row < box.y1; row++) {
    const [from, to] = [row * b.size.width + box.x0, row * b.size.width + box.x1];
    b.doc.overlay.set(before.subarray(from, to), from);
  }
  refreshMask(b, box);
}

// The corrected mask, and the canvas that shows it: colour on wall pixels.
function refreshMask(b, box) {
  if (isEmptyBox(box)) return;
  const { base, overlay } = b.doc;
  const [width, height] = [box.x1 - box.x0, box.y1 - box.y0];
  const image = new ImageData(width, height);
  const words = new Uint32Array(image.data.buffer);
  for (let row = 0, out = 0; row < height; row++) {
    let i = (box.y0 + row) * b.size.width + box.x0;
    for (let col = 0; col < width; col++, i++) {
      const isWall = overlay[i] ? overlay[i] === ADDED : base[i];
      b.mask.pixels[i] = isWall ? 1 : 0;
      // Stripes of four pixels, so that a piece is told without its colour.
      const isStripe = b.doubtful[i] && !overlay[i] && ((col + box.x0 + row + box.y0) & 4);
      words[out++] = isStripe ? b.doubtWord : isWall ? b.tintWord : 0;
    }
  }
  b.tint.getContext("2d").putImageData(image, box.x0, box.y0);
  requestPaint(b);
}

const isStraight = (b, event) => b.straight !== Boolean(event && event.shiftKey);

// The tools that change the wall mask. A tool starts a gesture: {move, end, cancel}.

const NEAR_PX = 0.25; // closer samples of the pointer say nothing new
const SMOOTH_CSS_PX = 0.35; // what simplifying may move a line, as seen on the screen

function freeLine(kind) {
  return (b, start) => {
    const before = b.grid.pixels.slice();
    const width = b.widths[kind];
    const raw = [start];
    let dirty = noBox();
    const add = (points) => {
      const box = applyStroke(b.grid, { kind, width, points });
      dirty = unionBox(dirty, box);
      refreshTint(b, box);
    };
    add([start]);
    return {
      move(point) {
        const last = raw[raw.length - 1];
        if (Math.hypot(point[0] - last[0], point[1] - last[1]) < NEAR_PX) return;
        raw.push(point);
        add([last, point]);
      },
      end() {
        restore(b, before, dirty);
        const tolerance = clamped(SMOOTH_CSS_PX / b.camera.scale, 0.25, 1);
        const stroke = madeStroke(kind, width, atMost(b.header.limits.strokePoints, raw, tolerance));
        refreshTint(b, unionBox(dirty, applyStroke(b.grid, stroke)));
        addStroke(b, stroke);
      },
      cancel() {
        restore(b, before, dirty);
        refreshTint(b, dirty);
      },
    };
  };
}

function twoPoints(kind) {
  return (b, start) => {
    const before = b.grid.pixels.slice();
    const width = b.widths[kind] ?? 1;
    let stroke = null;
    let dirty = noBox();
    const show = (point) => {
      restore(b, before, dirty);
      stroke = madeStroke(kind, width, [start, point]);
      const box = applyStroke(b.grid, stroke);
      refreshTint(b, unionBox(dirty, box));
      dirty = box;
    };
    const cancel = () => {
      restore(b, before, dirty);
      refreshTint(b, dirty);
    };
    b.anchor = start;
    return {
      move(point, event) {
        show(kind === "line" && isStraight(b, event) ? turnedTo45(start, point) : point);
      },
      end() {
        b.anchor = null;
        const [p, q] = stroke ? stroke.points : [start, start];
        // A click without a drag says nothing about where the other end would be.
        if (Math.hypot(q[0] - p[0], q[1] - p[1]) * b.camera.scale < 3) return cancel();
        addStroke(b, stroke);
      },
      cancel() {
        b.anchor = null;
        cancel();
      },
      get extent() {
        return stroke && stroke.points;
      },
    };
  };
}

function restore(b, before, box) {
  if (isEmptyBox(box)) return;
  const { width, pixels } = b.grid;
  for (let row = box.y0; row < box.y1; row++) {
    const [from, to] = [row * width + box.x0, row * width + box.x1];
    pixels.set(before.subarray(from, to), from);
  }
}

// The mask as the canvas shows it: a transparent image with colour on wall pixels.
function refreshTint(b, box) {
  if (isEmptyBox(box)) return;
  const [width, height] = [box.x1 - box.x0, box.y1 - box.y0];
  const image = new ImageData(width, height);
  const words = new Uint32Array(image.data.buffer);
  for (let row = 0, out = 0; row < height; row++) {
    let from = (box.y0 + row) * b.grid.width + box.x0;
    for (let col = 0; col < width; col++) words[out++] = b.grid.pixels[from++] ? b.tintWord : 0;
  }
  b.tint.getContext("2d").putImageData(image, box.x0, box.y0);
  requestPaint(b);
}

// "#rrggbb" as the bytes R, G, B, 255 read as one number in the machine's own order.
function wordOf(colour) {
  const bytes = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return new Uint32Array(new Uint8Array([...bytes, 255]).buffer)[0];
}

const isStraight = (b, event) => b.straight !== Boolean(event && event.shiftKey);

// GIF 89a: frames of few colours, each only where it differs from the one before.

const GIF_COLOURS = 256;
const LZW_CODES = 4096;

// The bytes of the parts collected so far, and the last frame's pixels.
function newGif(width, height, comment) {
  const gif = { width, height, parts: [], before: null };
  const head = [...letters("GIF89a"), ...pair(width), ...pair(height), 0x70, 0, 0];
  // Played once: a map that starts again by itself cannot be looked at. The comment holds
  // what the frames show.
  gif.parts.push(Uint8Array.from(head), Uint8Array.of(0x21, 0xfe), inBlocks(letters(comment)));
  return gif;
}

const letters = (text) => Array.from(text, (letter) => Math.min(letter.charCodeAt(0), 255));

const pair = (value) => [value & 255, value >> 8];

// Data in blocks of at most 255 bytes, each after its length, and an empty one.
function inBlocks(bytes) {
  const blocks = [];
  for (let at = 0; at < bytes.length; at += 255) {
    const block = bytes.slice(at, at + 255);
    blocks.push(block.length, ...block);
  }
  return Uint8Array.from([...blocks, 0]);
}

// Adds a frame of opaque pixels, red in the low byte, shown for some hundredths of a second.
function addFrame(gif, pixels, delayCs) {
  const box = changedBox(gif, pixels);
  const { indices, palette, bits } = indexed(gif, pixels, box);
  const shown = [0x21, 0xf9, 4, 0b101, ...pair(delayCs), 0, 0]; // index 0 is transparent
  const [left, top] = [pair(box.x0), pair(box.y0)];
  const size = [...pair(box.x1 - box.x0 + 1), ...pair(box.y1 - box.y0 + 1)];
  const image = [0x2c, ...left, ...top, ...size, 0x80 | (bits - 1)];
  gif.parts.push(Uint8Array.from([...shown, ...image]), palette, Uint8Array.of(bits), inBlocks(lzw(indices, bits)));
  gif.before = pixels;
}

const finished = ({ parts }) => new Blob([...parts, Uint8Array.of(0x3b)], { type: "image/gif" });

// Of a frame like the one before, one pixel.
function changedBox({ width, before }, pixels) {
  const box = newBox();
  for (let i = 0; i < pixels.length; i++) {
    if (!before || pixels[i] !== before[i]) growBox(box, i % width, Math.floor(i / width));
  }
  return box.x1 < 0 ? { x0: 0, y0: 0, x1: 0, y1: 0 } : box;
}

// ---- colours -----------------------------------------------------------------------------

// The pixels of a box as indices: 0 where nothing changed, else into a palette that holds
// the most frequent colours exactly; the others are edges of lines and letters.
function indexed({ width, before }, pixels, { x0, y0, x1, y1 }) {
  const inBox = new Uint32Array((x1 - x0 + 1) * (y1 - y0 + 1));
  const isNew = new Uint8Array(inBox.length);
  const times = new Map();
  let at = 0;
  for (let y = y0; y <= y1; y++) {
    for (let i = y * width + x0; i <= y * width + x1; i++, at++) {
      isNew[at] = !before || pixels[i] !== before[i] ? 1 : 0;
      inBox[at] = pixels[i];
      if (isNew[at]) times.set(pixels[i], (times.get(pixels[i]) ?? 0) + 1);
    }
  }
  const colours = [...times.keys()].sort((a, b) => times.get(b) - times.get(a));
  const kept = colours.slice(0, GIF_COLOURS - 1);
  const indexOf = new Map(kept.map((colour, i) => [colour, i + 1]));
  for (const colour of colours.slice(kept.length)) indexOf.set(colour, 1 + nearest(kept, colour));
  const bits = Math.max(2, Math.ceil(Math.log2(kept.length + 1)));
  const indices = Uint8Array.from(inBox, (colour, i) => (isNew[i] ? indexOf.get(colour) : 0));
  return { indices, palette: paletteBytes(kept, bits), bits };
}

const channels = (colour) => [colour & 255, (colour >> 8) & 255, (colour >> 16) & 255];

function nearest(colours, wanted) {
  const to = channels(wanted);
  const far = colours.map((colour) => channels(colour).reduce((sum, v, i) => sum + (v - to[i]) ** 2, 0));
  return far.indexOf(Math.min(...far));
}

function paletteBytes(colours, bits) {
  const bytes = new Uint8Array(3 << bits);
  colours.forEach((colour, i) => bytes.set(channels(colour), 3 * (i + 1)));
  return bytes;
}

// ---- compression -------------------------------------------------------------------------

// Lempel, Ziv and Welch as GIF has it: codes of growing width, low bits first.
function lzw(indices, bits) {
  const clear = 1 << bits;
  const table = new Uint16Array(LZW_CODES << 8); // by a code and the index after it
  const bytes = [];
  let [held, nHeld, width, next] = [0, 0, bits + 1, clear + 2];
  const emit = (code) => {
    held |= code << nHeld;
    for (nHeld += width; nHeld >= 8; nHeld -= 8, held >>= 8) bytes.push(held & 255);
  };
  emit(clear);
  let code = indices[0];
  for (let i = 1; i < indices.length; i++) {
    const key = (code << 8) | indices[i];
    if (table[key]) {
      code = table[key];
      continue;
    }
    emit(code);
    if (next === LZW_CODES) {
      emit(clear);
      table.fill(0);
      [width, next] = [bits + 1, clear + 2];
    } else {
      if (next === 1 << width) width++;
      table[key] = next++;
    }
    code = indices[i];
  }
  emit(code);
  emit(clear + 1);
  if (nHeld) bytes.push(held & 255);
  return bytes;
}

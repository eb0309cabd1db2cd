// Text in a PNG file: the facts of a figure travel with it.

const PNG_HEAD = 33; // the signature of 8 bytes and the chunk IHDR of 25

// Inserts a tEXt chunk for each keyword, after IHDR.
function pngWithText(bytes, facts) {
  const chunks = Object.entries(facts).map(([keyword, text]) => textChunk(`${keyword}\0${text}`));
  return new Blob([bytes.subarray(0, PNG_HEAD), ...chunks, bytes.subarray(PNG_HEAD)], { type: "image/png" });
}

// Length, type and data, checksum. PNG texts are Latin-1.
function textChunk(text) {
  const chunk = new Uint8Array(12 + text.length);
  const view = new DataView(chunk.buffer);
  const body = Array.from(`tEXt${text}`, (letter) => Math.min(letter.charCodeAt(0), 255));
  chunk.set(body, 4);
  view.setUint32(0, text.length);
  view.setUint32(8 + text.length, crc32(body));
  return chunk;
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 && 0xedb88320);
  }
  return ~crc >>> 0;
}

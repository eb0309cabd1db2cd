// Bytes from and to Python: the other half is `packed` in components/__init__.py.

// Unpacks the bytes of `packed`: [header, payload, payload, ...].
function readPacked(data) {
  const bytes = new Uint8Array(data.buffer ?? data, data.byteOffset, data.byteLength);
  const start = 4 + new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, start)));
  let at = start;
  const payloads = header.sizes.map((size) => bytes.subarray(at, (at += size)));
  return [header, ...payloads];
}

async function piped(bytes, transform) {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// zlib streams, compatible with Python's zlib.compress and zlib.decompress.
const inflated = (bytes) => piped(bytes, new DecompressionStream("deflate"));
const deflated = (bytes) => piped(bytes, new CompressionStream("deflate"));

// Such a stream at once, not compressed: blocks that are stored, then Adler's checksum.
function stored(bytes) {
  const most = 65535;
  const count = Math.max(Math.ceil(bytes.length / most), 1);
  const out = new Uint8Array(2 + 5 * count + bytes.length + 4);
  out.set([0x78, 0x01]);
  for (let k = 0, at = 2; k < count; k++) {
    const block = bytes.subarray(k * most, (k + 1) * most);
    const n = block.length;
    out.set([Number(k + 1 === count), n & 255, n >> 8, ~n & 255, (~n >> 8) & 255], at);
    out.set(block, at + 5);
    at += 5 + n;
  }
  let [a, b] = [1, 0];
  for (const byte of bytes) b = (b + (a = (a + byte) % 65521)) % 65521;
  new DataView(out.buffer).setUint32(out.length - 4, b * 65536 + a);
  return out;
}

// One bit a flag, high bit first, as numpy.packbits writes them.
function unpackBits(bytes, count) {
  const flags = new Uint8Array(count);
  for (let i = 0; i < count; i++) flags[i] = (bytes[i >> 3] >> (7 - (i & 7))) & 1;
  return flags;
}

// For what goes back to Python: a component's state is JSON.
const base64 = (bytes) => btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));

const pictureOf = (bytes) => createImageBitmap(new Blob([bytes]));

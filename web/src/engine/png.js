// PNG files and zlib streams by the browser's own compressor. Pixels stay as they are, whatever their alpha, which a
// canvas would round; and there is no limit but memory.

/** A zlib stream of some bytes. */
export async function deflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

function crc(bytes) {
  let c = 0xffffffff;
  for (let k = 0; k < bytes.length; k++) c = table[(c ^ bytes[k]) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** Length, name, data, checksum. */
function chunk(name, data) {
  const bytes = new Uint8Array(data.length + 12), view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  for (let k = 0; k < 4; k++) bytes[4 + k] = name.charCodeAt(k);
  bytes.set(data, 8);
  view.setUint32(8 + data.length, crc(bytes.subarray(4, 8 + data.length)));
  return bytes;
}

/** Rows, each as its differences from the one above (filter 2). */
function filtered(rgba, width, height) {
  const row = 4 * width, out = new Uint8Array((row + 1) * height);
  for (let y = 0; y < height; y++) {
    const to = y * (row + 1) + 1, from = y * row;
    out[to - 1] = 2;
    for (let k = 0; k < row; k++) out[to + k] = rgba[from + k] - (y ? rgba[from - row + k] : 0);
  }
  return out;
}

/** A PNG of [height][width][4] bytes, not premultiplied; dpi 0: it does not say. */
export async function encodePng({ rgba, width, height, dpi = 0 }) {
  const head = new Uint8Array(13), view = new DataView(head.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  head.set([8, 6, 0, 0, 0], 8);
  const parts = [new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head)];
  if (dpi) {
    const density = new Uint8Array(9), perMetre = Math.round(dpi / 0.0254);
    new DataView(density.buffer).setUint32(0, perMetre);
    new DataView(density.buffer).setUint32(4, perMetre);
    density[8] = 1;
    parts.push(chunk('pHYs', density));
  }
  parts.push(chunk('IDAT', await deflate(filtered(rgba, width, height))), chunk('IEND', new Uint8Array(0)));
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

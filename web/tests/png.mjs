/* Reads PNG files of 8 bits a channel, not interlaced: {width, height, data: RGBA, 4 bytes a pixel}. */
import { inflateSync } from 'node:zlib';

const channels_of_type = { 0: 1, 2: 3, 4: 2, 6: 4 }; // grey, RGB, grey + alpha, RGBA

function paeth(left, above, corner) {
    const p = left + above - corner;
    const [a, b, c] = [Math.abs(p - left), Math.abs(p - above), Math.abs(p - corner)];
    if (a <= b && a <= c) return left;
    return b <= c ? above : corner;
}

/* Undoes the filters of the rows, each of which begins with its filter's number. */
function unfilter(raw, width, height, channels) {
    const pitch = width * channels;
    const out = new Uint8Array(pitch * height);
    for (let y = 0; y < height; y++) {
        const filter = raw[y * (pitch + 1)];
        const from = y * (pitch + 1) + 1;
        const to = y * pitch;
        for (let i = 0; i < pitch; i++) {
            const left = i >= channels ? out[to + i - channels] : 0;
            const above = y ? out[to + i - pitch] : 0;
            const corner = y && i >= channels ? out[to + i - pitch - channels] : 0;
            const guess = [0, left, above, (left + above) >> 1, paeth(left, above, corner)][filter];
            out[to + i] = raw[from + i] + guess;
        }
    }
    return out;
}

export function read_png(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (view.getUint32(0) !== 0x89504e47) throw new Error('no PNG file');
    let width, height, type;
    const data = [];
    for (let at = 8; at < bytes.length; ) {
        const length = view.getUint32(at);
        const name = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
        if (name === 'IHDR') {
            width = view.getUint32(at + 8);
            height = view.getUint32(at + 12);
            type = bytes[at + 17];
            if (bytes[at + 16] !== 8 || bytes[at + 20] || !channels_of_type[type]) throw new Error('a PNG file of another kind');
        } else if (name === 'IDAT') {
            data.push(bytes.subarray(at + 8, at + 8 + length));
        }
        at += 12 + length;
    }
    const channels = channels_of_type[type];
    const rows = unfilter(inflateSync(Buffer.concat(data)), width, height, channels);
    const rgba = new Uint8Array(width * height * 4);
    for (let i = 0; i < width * height; i++) {
        const p = rows.subarray(i * channels, (i + 1) * channels);
        const grey = channels < 3;
        rgba.set([p[0], grey ? p[0] : p[1], grey ? p[0] : p[2], channels % 2 ? 255 : p[channels - 1]], i * 4);
    }
    return { width, height, data: rgba };
}

/* Saving: PNG of the screen's and other sizes, SVG and PDF, as the native program writes them. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { make_model, output_of, place, sha256, test } from './bench.mjs';
import { read_png } from './png.mjs';

async function with_model(bench) {
    const visit = await bench.visit();
    await visit.change(() => visit.drop([make_model('bracket', 'bracket.ply')]));
    await visit.change(() => visit.page.selectOption('#hidden', 'dashed'));
    return visit;
}

function installed(program) {
    try {
        execFileSync('sh', ['-c', `command -v ${program}`], { stdio: 'ignore' });
        return true;
    } catch {
        return false;
    }
}

async function set_size(page, width, height) {
    const picked = page.locator('#size-preset');
    if (await picked.count()) await picked.selectOption('own');
    await page.fill('#size-width', String(width));
    await page.fill('#size-height', String(height));
}

test('a saved PNG file holds the picture', async (bench) => {
    const visit = await with_model(bench);
    const { name, bytes } = await visit.download('#save-png');
    assert.match(name, /\.png$/);
    const saved = read_png(bytes);
    assert.equal(sha256(saved.data), (await visit.picture()).hash);
});

test('a PNG file of another size is the program\'s', async (bench) => {
    const visit = await with_model(bench);
    const command = await visit.command();
    await set_size(visit.page, 1111, 1500);
    const saved = read_png((await visit.download('#save-png')).bytes);
    assert.deepEqual([saved.width, saved.height], [1111, 1500]);
    const sized = command.replace(/--size \d+x\d+ ?/, '').replace(/ -o /, ' --size 1111x1500 -o ');
    assert.equal(sha256(saved.data), sha256(read_png(output_of(sized)).data), sized);
});

test('a saved SVG file is the program\'s, byte for byte', async (bench) => {
    const visit = await with_model(bench);
    const { name, bytes } = await visit.download('#save-svg');
    assert.match(name, /\.svg$/);
    const native = output_of(await visit.command(), '.svg');
    assert.equal(bytes.toString().slice(0, 300), native.toString().slice(0, 300));
    assert.equal(sha256(bytes), sha256(native));
});

test('a saved PDF file is sound, and its page has the picture\'s shape', async (bench) => {
    const visit = await with_model(bench);
    const { name, bytes } = await visit.download('#save-pdf');
    assert.match(name, /\.pdf$/);
    assert.equal(bytes.subarray(0, 5).toString(), '%PDF-');
    const file = path.join(place.folder, 'saved.pdf');
    writeFileSync(file, bytes);
    const looked = [];
    if (installed('qpdf')) {
        execFileSync('qpdf', ['--check', file], { stdio: 'pipe' });
        looked.push('qpdf');
    }
    if (installed('pdftoppm')) {
        const ppm = execFileSync('pdftoppm', ['-r', '20', file], { stdio: ['ignore', 'pipe', 'pipe'] });
        const [, width, height] = /^P6\s+(\d+)\s+(\d+)/.exec(ppm.subarray(0, 30).toString('latin1'));
        const picture = await visit.picture();
        assert.ok(Math.abs(width / height - picture.width / picture.height) < 0.05, `${width} by ${height}`);
        const body = ppm.subarray(20);
        assert.ok(body.some((byte) => byte < 128), 'nothing is drawn');
        looked.push('pdftoppm');
    }
    return `looked at by ${looked.join(', ') || 'nothing'}`;
});

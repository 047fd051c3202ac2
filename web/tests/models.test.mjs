/* Models: dropped and picked, several, broken, large, cancelled. */
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { make_model, patience, place, test } from './bench.mjs';

/* Writes a file where the native program finds it too. */
function written(name, data) {
    const file = path.join(place.folder, name);
    writeFileSync(file, data);
    return file;
}

const tetrahedra = `mtllib paint.mtl
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 2 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1
g left\nusemtl blue\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
g right\nusemtl yellow\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8
`;
const paint = 'newmtl blue\nKd 0.1 0.2 0.8\nnewmtl yellow\nKd 0.9 0.8 0.1\n';

test('a dropped STL file is drawn', async (bench) => {
    const file = make_model('gear', 'gear.stl');
    const visit = await bench.visit();
    await visit.change(() => visit.drop([file]));
    assert.match(await visit.command(), /\bgear\.stl\b/);
    assert.match(await visit.model(), /gear/);
    await visit.same_as_program();
});

test('a picked OBJ file takes its colours from the MTL file beside it', async (bench) => {
    const files = [written('pair.obj', tetrahedra), written('paint.mtl', paint)];
    const visit = await bench.visit();
    await visit.change(() => visit.page.setInputFiles('#file', files));
    await visit.change(() => visit.page.selectOption('#style', 'flat').catch(() => visit.page.selectOption('#style', { index: 1 })));
    await visit.same_as_program();
});

for (const ending of ['ply', 'obj']) {
    test(`a dropped ${ending.toUpperCase()} file is drawn`, async (bench) => {
        const file = make_model('bracket', `bracket.${ending}`);
        const visit = await bench.visit();
        await visit.change(() => visit.drop([file]));
        await visit.same_as_program();
    });
}

test('several models are one scene', async (bench) => {
    const files = [make_model('cube', 'cube.stl'), make_model('torus', 'torus.ply')];
    const visit = await bench.visit();
    await visit.change(() => visit.drop(files));
    const command = await visit.command();
    assert.match(command, /cube\.stl/);
    assert.match(command, /torus\.ply/);
    await visit.same_as_program();
});

const broken = {
    'an empty file': { name: 'empty.stl', data: '' },
    'a file cut short': { name: 'short.stl', data: Buffer.concat([Buffer.alloc(80), Buffer.from([200, 0, 0, 0]), Buffer.alloc(30)]) },
    'a text that is no model': { name: 'letter.obj', data: 'Dear model,\nf 1 2 3\n' },
    'a file of no known kind': { name: 'song.mp3', data: Buffer.from('ID3 song') },
    'a broken GLB file': { name: 'broken.glb', data: Buffer.concat([Buffer.from('glTF'), Buffer.from([2, 0, 0, 0, 255, 255, 255, 127]), Buffer.alloc(40, 7)]) },
};

test('broken files get a message, and the model that was there stays', async (bench) => {
    const visit = await bench.visit();
    await visit.change(() => visit.drop([make_model('bracket', 'bracket.ply')]));
    const [command, { hash }] = [await visit.command(), await visit.picture()];
    for (const [what, file] of Object.entries(broken)) {
        await visit.drop([file]);
        await visit.message(new RegExp(file.name.replace('.', '\\.')));
        await visit.ready();
        assert.equal(await visit.command(), command, what);
        assert.equal((await visit.picture()).hash, hash, what);
    }
    await visit.change(() => visit.page.click('[data-view=back]'));
    await visit.same_as_program();
});

test('twenty files dropped at once, some of them no models', async (bench) => {
    const cube = make_model('cube', 'cube.ply');
    const { readFileSync } = await import('node:fs');
    const data = readFileSync(cube);
    const files = [];
    for (let i = 0; i < 20; i++) files.push({ name: i % 5 ? `cube-${i}.ply` : `note-${i}.txt`, data: i % 5 ? data : 'note' });
    const visit = await bench.visit();
    await visit.drop(files);
    await visit.page.waitForFunction(() => document.querySelector('#command').textContent.includes('cube-1.ply') || document.querySelector('#messages').textContent.trim(), null, { timeout: patience });
    await visit.ready();
    await visit.change(() => visit.drop([make_model('gear', 'gear.stl')])); // it still works
    await visit.same_as_program();
});

test('every example of the gallery is drawn', async (bench) => {
    const visit = await bench.visit();
    const buttons = visit.page.locator('#gallery button');
    const count = await buttons.count();
    assert.ok(count >= 6, `${count} examples`);
    for (let i = 1; i < count; i++) {
        const before = await visit.command();
        await buttons.nth(i).click();
        await visit.page.waitForFunction((old) => document.querySelector('#command').textContent.trim() !== old && document.documentElement.dataset.state === 'ready', before, { timeout: patience });
    }
    await visit.same_as_program();
    return `${count} examples`;
});

test('a file of 100 MB is drawn, with progress', async (bench) => {
    const file = make_model('terrain --triangles 2000000', 'large.stl');
    const visit = await bench.visit();
    const start = performance.now();
    await visit.change(() => visit.page.setInputFiles('#file', file));
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    assert.match(await visit.command(), /large\.stl/);
    const seen = await visit.page.evaluate(() => window.progress_seen.filter(({ what }) => what === 'reading').length);
    assert.ok(seen > 0, 'no progress was told');
    await visit.same_as_program();
    return `drawn after ${seconds} s`;
}, { slow: true });

test('reading a large file is cancelled, and the model that was there stays', async (bench) => {
    const file = make_model('terrain --triangles 2000000', 'large.stl');
    const visit = await bench.visit();
    const [command, { hash }] = [await visit.command(), await visit.picture()];
    await visit.page.evaluate(() => { // while it is read, however fast that is
        const { engine } = window.drypoint;
        const cancel = ({ detail }) => {
            if (detail.what !== 'reading') return;
            engine.removeEventListener('progress', cancel);
            document.querySelector('#cancel').click();
        };
        engine.addEventListener('progress', cancel);
    });
    await visit.page.setInputFiles('#file', file);
    await visit.ready();
    await visit.page.waitForTimeout(300);
    assert.equal(await visit.command(), command);
    assert.equal((await visit.picture()).hash, hash);
    await visit.change(() => visit.page.click('[data-view=back]'));
    await visit.same_as_program();
}, { slow: true });

/* glue.mjs [FOLDER]: tests the C side of the page (web/c) in Node, without a browser or a canvas: what opens, what is
 * refused and leaves all as it was, which command line comes of it, what is saved. FOLDER holds the build with one
 * thread; default build/web-single. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const folder = path.resolve(process.argv[2] ?? path.join(here, '../../build/web-single'));

/* The module believes that it runs in a worker. */
globalThis.importScripts = () => {};
globalThis.self = globalThis;
globalThis.location = { href: pathToFileURL(folder + '/').href };

const said = [];
const saved = { pieces: [], picture: null, wanted: 0 };
let stop = 0;
const { default: create } = await import(pathToFileURL(path.join(folder, 'drypoint.mjs')));
const m = await create({
    wasmBinary: await readFile(path.join(folder, 'drypoint.wasm')),
    print: () => {},
    printErr: (line) => said.push(line),
    tellProgress: () => stop,
    tellBytes: (at, size) => saved.pieces.push(m.HEAPU8.slice(at, at + size)),
    tellPicture: (at, width, height) => (saved.picture = { width, height, rgba: m.HEAPU8.slice(at, at + 4 * width * height) }),
    tellDeflated: () => (saved.wanted++, 0),
    tellEncoded: () => (saved.wanted++, 0),
});

function with_text(text, call) {
    if (text === null) return call(0);
    const size = m.lengthBytesUTF8(text) + 1;
    const at = m._malloc(size);
    m.stringToUTF8(text, at, size);
    const answer = call(at);
    m._free(at);
    return answer;
}
const state = () => JSON.parse(m.UTF8ToString(m._web_state()));
const open = (names) => with_text(names, (at) => m._web_open(at));
function add(name, text) {
    const bytes = new TextEncoder().encode(text);
    const at = m._malloc(Math.max(bytes.length, 1));
    m.HEAPU8.set(bytes, at);
    assert.equal(with_text(name, (n) => m._web_file(n, at, bytes.length)), 0);
}
const change = (name, value) => with_text(name, (n) => with_text(value, (v) => m._web_change(n, v)));
function set(values) {
    assert.equal(m._web_begin_changes(), 0);
    for (const [name, value] of Object.entries(values)) if (change(name, value)) return 1;
    return m._web_accept();
}
function restore(text) {
    m._web_begin_changes();
    return with_text(text, (at) => m._web_restore(at)) || m._web_accept();
}
const hash = () => m.UTF8ToString(m._web_hash());
function save(kind) {
    saved.pieces = [], saved.picture = null;
    assert.equal(with_text(kind, (at) => m._web_save(at, 200, 150)), 0, said.at(-1));
    return Buffer.concat(saved.pieces).toString('latin1');
}

m._web_begin(1);

const tests = {
    'tells options, presets, shapes and textures'() {
        const info = JSON.parse(m.UTF8ToString(m._web_info()));
        const names = info.options.map((o) => o.name);
        for (const name of ['width', 'color', 'ridge-angle', 'up', 'azimuth', 'hidden', 'time']) assert.ok(names.includes(name), name);
        for (const name of ['size', 'threads', 'output', 'backend', 'quiet']) assert.ok(!names.includes(name), name);
        assert.deepEqual([...new Set(names)], names, 'each once');
        assert.ok(info.presets.some((p) => p.name === 'technical' && p.options.includes('--hidden dashed')));
        assert.ok(info.shapes.some((s) => s.name === 'bolt' && s.about));
    },
    'options are kept before there is a model'() {
        assert.equal(set({ style: 'paper' }), 0);
        assert.equal(state().model, null);
        assert.equal(m._web_draw(0), 1);
        assert.equal(set({ style: null }), 0);
    },
    'opens a shape and draws it'() {
        m._web_resize(200, 150);
        assert.equal(open('shape:bolt'), 0, said.at(-1));
        assert.equal(m._web_draw(0), 0);
        const s = state();
        assert.equal(s.model.name, 'shape:bolt');
        assert.equal(s.command, 'drypoint shape:bolt --size 200x150 -o bolt.png');
        assert.equal(s.options, '');
        assert.ok(s.effective.lines.silhouette.on);
    },
    'a refused option changes nothing, and says why'() {
        const before = state();
        const picture = hash();
        for (const [name, value, why] of [
            ['width', 'thick', /thick/],
            ['ridge-angle', '400', /400/],
            ['threads', '4', /--threads/],
            ['nonsense', '1', /nonsense/],
            ['stroke', 'a/b.png', /PNG/],
            ['only', 'nobody', /no names/],
            ['view', 'inside', /inside/],
        ]) {
            said.length = 0;
            assert.notEqual(set({ style: 'toon', [name]: value }), 0, name);
            assert.match(said.join('\n'), why);
            assert.deepEqual(state(), before, name);
        }
        assert.equal(m._web_draw(0), 0);
        assert.equal(hash(), picture);
    },
    'a broken file leaves the old model'() {
        const before = state();
        add('broken.ply', 'ply\nformat ascii 1.0\nelement vertex many\n');
        said.length = 0;
        assert.equal(open('broken.ply'), 1);
        assert.match(said.join('\n'), /broken\.ply/);
        assert.deepEqual(state(), before);
        assert.equal(open('absent.stl'), 1);
        assert.match(said.at(-1), /absent\.stl/);
        assert.equal(m._web_draw(0), 0);
    },
    'the camera moves as words, and comes back by them'() {
        const at_first = hash();
        m._web_turn(0.25, 0.1);
        assert.equal(m._web_draw(0), 0);
        const turned = state();
        assert.match(turned.options, /--eye.* --target.* --fov/);
        assert.notEqual(hash(), at_first);
        const picture = hash();
        assert.equal(restore(''), 0);
        m._web_draw(0);
        assert.equal(hash(), at_first);
        assert.equal(restore(turned.options), 0);
        m._web_draw(0);
        assert.equal(hash(), picture);
        assert.equal(with_text('front', (at) => m._web_view(at)), 0);
        m._web_project(1);
        assert.match(state().options, /--view front --ortho 0/);
        assert.equal(restore(''), 0);
    },
    'words with spaces and quotes survive'() {
        assert.equal(set({ title: `a 'b' "c" \\d` }), 1, 'no option of a page');
        add("a 'quoted' name.off", 'OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n');
        assert.equal(open("a 'quoted' name.off"), 0, said.at(-1));
        m._web_draw(0);
        assert.ok(state().command.startsWith(`drypoint 'a '\\''quoted'\\'' name.off'`), state().command);
    },
    'a preset takes the place of a look'() {
        assert.equal(set({ color: 'ridge=red', surface: '#ff0000' }), 0);
        assert.equal(set({ preset: 'technical' }), 0);
        const { words, effective } = state();
        assert.equal(words.preset, 'technical');
        assert.equal(words.color, undefined);
        assert.equal(effective.hidden, 'dashed');
        assert.equal(restore(''), 0);
    },
    'materials lie beside a model'() {
        const obj = 'mtllib Colors.MTL\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n';
        add('box.obj', obj);
        add('colors.mtl', 'newmtl red\nKd 1 0 0\n');
        assert.equal(open('box.obj'), 0, said.at(-1));
        assert.equal(set({ style: 'lambert' }), 0);
        m._web_draw(0);
        const at = m._web_pixels();
        const rgba = m.HEAPU8.slice(at, at + 4 * 200 * 150);
        let red = 0;
        for (let k = 0; k < rgba.length; k += 4) red += rgba[k] > 100 && rgba[k + 1] < 20;
        assert.ok(red > 500, `${red} red pixels`);
        assert.equal(restore(''), 0);
    },
    'several models are one scene'() {
        assert.equal(open('shape:cube\nshape:bolt'), 0, said.at(-1));
        m._web_draw(0);
        assert.match(state().model.name, /cube and .*bolt/);
        assert.equal(set({ only: 'shape:cube' }), 0, said.at(-1));
        m._web_draw(0);
        assert.equal(state().model.polygons, 12);
        assert.equal(set({ only: null }), 0);
    },
    'drawing can be stopped'() {
        stop = 1;
        assert.equal(m._web_draw(0), 2);
        assert.equal(open('shape:terrain:2000000'), 0);
        assert.equal(m._web_draw(0), 2);
        stop = 0;
        assert.equal(open('shape:bolt'), 0);
        assert.equal(m._web_draw(0), 0);
    },
    'saves every format'() {
        assert.match(save('svg'), /<svg[^]*<\/svg>\s*$/);
        assert.match(save('eps'), /^%!PS-Adobe/);
        assert.match(save('dxf'), /EOF\s*$/);
        assert.doesNotThrow(() => JSON.parse(save('json')));
        save('pdf');
        assert.ok(saved.wanted > 0);
        save('png');
        assert.deepEqual([saved.picture.width, saved.picture.height], [200, 150]);
        assert.equal(m._web_draw(0), 0);
        assert.deepEqual(saved.picture.rgba, m.HEAPU8.slice(m._web_pixels(), m._web_pixels() + 4 * 200 * 150));
    },
    'drafts are of the simplified model'() {
        assert.equal(m._web_mesh(), 0);
        const parts = new Float64Array(m.HEAPU8.buffer, m._web_mesh_parts(), 5);
        const [, vertices, , triangles] = parts;
        assert.equal(triangles, state().model.polygons);
        assert.ok(vertices > 8);
        m._web_mesh_free();
        const block = (array) => {
            const at = m._malloc(array.byteLength);
            m.HEAPU8.set(new Uint8Array(array.buffer), at);
            return at;
        };
        const few = [new Float32Array([0, -1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]), new Uint16Array(4)];
        const full = hash();
        assert.equal(m._web_draft(block(few[0]), 4, block(few[1]), 4, block(few[2])), 0);
        assert.equal(m._web_draw(1), 0);
        assert.notEqual(hash(), full);
        assert.equal(m._web_draw(0), 0);
        assert.equal(hash(), full);
    },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
    try {
        test();
        console.log(`ok   ${name}`);
    } catch (error) {
        failed++;
        console.log(`FAIL ${name}\n${error.message ?? error}\n${String(error.stack).split('\n')[1]}`);
    }
}
console.log(failed ? `${failed} of ${Object.keys(tests).length} failed` : `all ${Object.keys(tests).length} passed`);
process.exit(failed ? 1 : 0);

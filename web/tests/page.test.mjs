/* The page's own thinking, without a browser: history, links, sorting of files, words of options. */
import assert from 'node:assert/strict';
import { sort_files } from '../src/page/files.js';
import { History } from '../src/page/history.js';
import { read_link, split_words, without_camera, write_link } from '../src/page/link.js';
import { digits, with_piece } from '../src/page/words.js';
import { test } from './bench.mjs';

test('history: steps of one slider are one, other steps are not', () => {
    const history = new History();
    const model = {};
    history.push('', model, '', 0);
    for (let k = 1; k <= 5; k++) history.push(`--ridge-angle ${k}`, model, 'ridge-angle', 1000 + 100 * k);
    history.push('--ridge-angle 5 --view front', model, '', 3000);
    assert.deepEqual(history.moments.map(({ text }) => text), ['', '--ridge-angle 5', '--ridge-angle 5 --view front']);
    history.go(-1);
    history.push('--hidden dashed', model, '', 4000);
    assert.equal(history.can_redo, false);
    assert.deepEqual(history.moments.map(({ text }) => text), ['', '--ridge-angle 5', '--hidden dashed']);
    assert.equal(history.push('--hidden dashed', model, '', 5000), false);
});

test('history: it begins with the first moment, and forgets the oldest', () => {
    const history = new History();
    const model = {};
    assert.deepEqual([history.can_undo, history.can_redo, history.at(-1)], [false, false, null]);
    for (let k = 0; k < 300; k++) history.push(String(k), model, '', 1000 * k);
    assert.equal(history.moments.length, 200);
    assert.equal(history.at(0).text, '299');
    assert.equal(history.at(-199).text, '100');
    history.go(-1);
    history.begin_here();
    assert.deepEqual([history.at(0).text, history.can_undo, history.can_redo], ['298', false, false]);
});

test('links come back as they were written', () => {
    for (const [shape, text] of [['bolt', "--color '#c02020' --eye 1e-3,-2,+3 --title 'a & b=c 100%'"], ['terrain:4000', ''], [null, '--view front']]) {
        const link = read_link(`#${write_link(shape, text)}`);
        assert.deepEqual(link, { shape, text: text || null, wrong: null });
    }
});

test('links that make no sense say so', () => {
    for (const hash of ['#--ridge-angle banana', '#%ff%fe', '#model=x', '#shape=../../etc', `#with=${'x'.repeat(9000)}`]) {
        const { shape, text, wrong } = read_link(hash);
        assert.ok(wrong, hash);
        assert.deepEqual([shape, text], [null, null], hash);
    }
    for (const hash of ['', '#']) assert.deepEqual(read_link(hash), { shape: null, text: null, wrong: null });
});

test('options without those of the camera', () => {
    assert.equal(without_camera('--azimuth -30 --elevation=2 --width ridge=2 --ortho 0 --hidden-smooth'), '--width ridge=2 --hidden-smooth');
    assert.equal(without_camera("--title 'seen from --view' --view front"), "--title 'seen from --view'");
    assert.deepEqual(split_words(`a 'b c' "d \\" e" f'g h'`), ['a', "'b c'", '"d \\" e"', "f'g h'"]);
});

test('pieces for classes of lines', () => {
    assert.equal(with_piece(undefined, 'ridge', '2'), 'ridge=2');
    assert.equal(with_piece('3,ridge=1,valley=4', 'ridge', '2'), '3,valley=4,ridge=2');
    assert.equal(digits(2.34567, 3), '2.35');
    assert.equal(digits(100, 3), '100');
});

const file = (name, size = 100) => ({ name, size });
const sorted = (...files) => {
    const { files: chosen, error, warning } = sort_files(files);
    return { names: chosen.map(({ name }) => name), error, warning };
};

test('files: what is opened, and what is said of the others', () => {
    assert.deepEqual(sorted(file('a.mtl'), file('a.OBJ')), { names: ['a.OBJ', 'a.mtl'], error: null, warning: null });
    assert.deepEqual(sorted(file('a.gltf'), file('a.bin'), file('t.png')), { names: ['a.gltf', 'a.bin'], error: null, warning: null });
    assert.match(sorted(file('a.stl'), file('b.stl', 0), file('c.xyz')).warning, /b\.stl.*empty.*c\.xyz/);
    assert.match(sorted(file('a.stl', 0)).error, /a\.stl.*empty/);
    assert.match(sorted(file('a.mtl')).error, /together/);
    assert.match(sorted(file('song.mp3')).error, /song\.mp3.*STL/);
    assert.match(sorted().error, /no file/);
    assert.equal(sorted(...Array.from({ length: 20 }, (_, k) => file(`${k}.ply`))).names.length, 20);
});

/* Files that are dropped or picked: what of them can be a model, and what to say if nothing can. */
import { by_id, on } from './dom.js';
import { tell } from './messages.js';

const model_endings = new Set(['stl', 'ply', 'obj', 'off', 'glb', 'gltf']);
const beside_endings = new Set(['mtl', 'bin']);
const deepest = 3; /* folders in folders */
const most = 500; /* files of a folder */

export const formats = 'STL, PLY, OBJ, OFF, glTF and GLB';

const ending = (name) => /\.([^./]+)$/.exec(name.toLowerCase())?.[1] ?? '';
const names = (files) => {
    const first = files.slice(0, 3).map((file) => `“${file.name}”`);
    return first.join(', ') + (files.length > 3 ? ` and ${files.length - 3} more` : '');
};

/** {files, error, warning}: those that the engine is to open; or why there are none. */
export function sort_files(files) {
    if (!files.length) return { files: [], error: 'There was no file in what was dropped.', warning: null };
    const models = files.filter((file) => model_endings.has(ending(file.name)));
    const beside = files.filter((file) => beside_endings.has(ending(file.name)));
    const empty = models.filter((file) => file.size === 0);
    const full = models.filter((file) => file.size > 0);
    const others = files.filter((file) => !models.includes(file) && !beside.includes(file));
    if (full.length) {
        const told = [];
        if (empty.length) told.push(`${names(empty)}: empty, left out.`);
        const unknown = others.filter((file) => !/\.(png|jpe?g|webp|tga|bmp|gif|ktx2?|txt|md|json|html?|license)$/i.test(file.name));
        if (unknown.length) told.push(`${names(unknown)}: not a model that can be read here, left out.`);
        return { files: [...full, ...beside], error: null, warning: told.join(' ') || null };
    }
    if (empty.length) return { files: [], error: `${names(empty)}: the file is empty (0 bytes).`, warning: null };
    if (beside.length && !others.length)
        return { files: [], error: `${names(beside)} lies beside a model: drop it together with the .obj or .gltf.`, warning: null };
    const verb = others.length > 1 ? 'are no models' : 'is no model';
    return { files: [], error: `${names(others)} ${verb} that can be read here: ${formats} can.`, warning: null };
}

/** Opens files if there is a model among them. */
export function open_files(app, files) {
    const sorted = sort_files([...files]);
    if (sorted.error) return tell(sorted.error, 'error');
    if (sorted.warning) tell(sorted.warning, 'warning');
    return app.open({ files: sorted.files });
}

/* ------- folders ------- */

const read_some = (reader) => new Promise((resolve, reject) => reader.readEntries(resolve, reject));
const file_of = (entry) => new Promise((resolve, reject) => entry.file(resolve, reject));

async function gather(entry, depth, files) {
    if (files.length >= most) return;
    if (entry.isFile) {
        if (!entry.name.startsWith('.')) files.push(await file_of(entry));
        return;
    }
    if (depth >= deepest) return;
    const reader = entry.createReader();
    for (let some = await read_some(reader); some.length; some = await read_some(reader))
        for (const each of some) await gather(each, depth + 1, files);
}

/* All files of what was dropped, those in folders, too. */
async function dropped_files(transfer) {
    const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
    if (!entries.some((entry) => entry.isDirectory)) return [...transfer.files];
    const files = [];
    for (const entry of entries) await gather(entry, 0, files); // entries stay valid after the event
    return files;
}

/* ------- events ------- */

const holds_files = (event) => event.dataTransfer?.types.includes('Files');

async function take_drop(app, event) {
    if (!holds_files(event)) return;
    event.preventDefault();
    by_id('drop').hidden = true;
    try {
        await open_files(app, await dropped_files(event.dataTransfer));
    } catch {
        tell('What was dropped cannot be read: the browser gives no access to it.', 'error');
    }
}

export function bind_files(app) {
    const input = by_id('file');
    const target = by_id('drop');
    on(by_id('open'), 'click', () => input.click());
    on(input, 'change', () => {
        const files = [...input.files];
        input.value = ''; // so that the same file can be picked again
        if (files.length) open_files(app, files);
    });
    on(window, 'dragenter dragover', (event) => {
        if (!holds_files(event)) return;
        event.preventDefault();
        event.dataTransfer.dropEffect = 'copy';
        target.hidden = false;
    });
    on(window, 'dragleave', (event) => {
        if (!event.relatedTarget) target.hidden = true;
    });
    on(window, 'drop', (event) => take_drop(app, event));
    on(window, 'paste', (event) => {
        if (event.clipboardData?.files.length) open_files(app, event.clipboardData.files);
    });
}

/* The part of the page's address behind #: all but the model, which is named there if it is a generated one.
 *
 *   #shape=bolt&with=--preset technical --view front      (spaces as +)
 *
 * Nothing of it is sent to a server: browsers keep what is behind # to themselves. */

const longest = 8000; /* characters of options: more was not written by this page */

/** {shape, text} of an address, either may be null; `wrong` is a sentence if something in it makes no sense. */
export function read_link(hash) {
    const found = { shape: null, text: null, wrong: null };
    if (hash.length < 2) return found;
    const words = new URLSearchParams(hash.slice(1)); // takes anything
    const shape = words.get('shape');
    const text = words.get('with');
    if (shape === null && text === null) {
        found.wrong = 'The link says nothing that Drypoint knows.';
        return found;
    }
    if (shape !== null && /^[a-z]+(:[0-9]+)*$/.test(shape)) found.shape = shape;
    else if (shape !== null) found.wrong = `The link names a shape that there cannot be: ${shape.slice(0, 60)}`;
    if (text !== null && text.length <= longest) found.text = text.trim();
    else if (text !== null) found.wrong = 'The link’s options are too long.';
    return found;
}

/** What is behind # for a shape (null: a file, which no link holds) and options. */
export function write_link(shape, text) {
    const words = new URLSearchParams();
    if (shape) words.set('shape', shape);
    if (text) words.set('with', text);
    // letters that a fragment may have as they are
    return words.toString().replaceAll('%2C', ',').replaceAll('%3A', ':').replaceAll('%3D', '=');
}

/* Options that say where from. */
export const camera_names = new Set(['eye', 'target', 'fov', 'ortho', 'view', 'azimuth', 'elevation', 'zoom']);

/** The options without those of the camera: what one model's camera sees of another is nothing. */
export function without_camera(text) {
    const words = split_words(text);
    const kept = [];
    for (let k = 0; k < words.length; k++) {
        const name = /^--([a-z-]+)(=|$)/.exec(words[k]);
        if (name && camera_names.has(name[1])) {
            if (!name[2] && k + 1 < words.length && !words[k + 1].startsWith('--')) k++;
            continue;
        }
        kept.push(words[k]);
    }
    return kept.join(' ');
}

/** Words of a shell's line, quotes kept. */
export const split_words = (text) => text.match(/(?:[^\s'"]|'[^']*'|"(?:[^"\\]|\\.)*")+/g) ?? [];

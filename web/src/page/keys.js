/* The keys: one table serves the keyboard and the help. Letters act while the drawing has the focus, or nothing has. */
import { by_id, make, on } from './dom.js';
import { recall, remember } from './store.js';

const control = /Mac|iPhone|iPad/.test(navigator.platform) ? '⌘' : 'Ctrl';

/* [keys, what help calls them, what they do, act]; keys are KeyboardEvent.key. Rows without a name are told in the row above;
 * arrows are looked at by themselves. */
const table = (app, page) => [
    ['', 'arrows', 'turn by five degrees', null],
    ['', 'shift + arrows', 'move', null],
    ['+ =', '+ −', 'nearer, farther', () => app.zoom(1.25)],
    ['- −', '', '', () => app.zoom(1 / 1.25)],
    ['PageUp', 'page up, page down', 'nearer, farther', () => app.zoom(1.25)],
    ['PageDown', '', '', () => app.zoom(1 / 1.25)],
    ['f F', 'f', 'fit the model into the picture', () => app.fit()],
    ['1', '1 … 7', 'front, right, top, back, left, bottom, isometric', () => app.view('front')],
    ['2', '', '', () => app.view('right')],
    ['3', '', '', () => app.view('top')],
    ['4', '', '', () => app.view('back')],
    ['5', '', '', () => app.view('left')],
    ['6', '', '', () => app.view('bottom')],
    ['7', '', '', () => app.view('iso')],
    ['0', '0', 'the view of the beginning', () => page.first_view()],
    ['o O', 'o', 'orthographic, or in perspective', () => app.project(!page.orthographic())],
    ['w', 'w, W', 'wider, narrower lines', () => page.widths(1)],
    ['W', '', '', () => page.widths(-1)],
    ['r', 'r, R', 'fewer, more ridges: five degrees', () => page.angle('ridge-angle', -5)],
    ['R', '', '', () => page.angle('ridge-angle', 5)],
    ['v', 'v, V', 'fewer, more valleys: five degrees', () => page.angle('valley-angle', 5)],
    ['V', '', '', () => page.angle('valley-angle', -5)],
    ['d', 'd, D', 'next, previous detail', () => page.next('detail', 1)],
    ['D', '', '', () => page.next('detail', -1)],
    ['h', 'h, H', 'next, previous kind of hidden lines', () => page.next('hidden', 1)],
    ['H', '', '', () => page.next('hidden', -1)],
    ['x X', 'x', 'see-through surfaces on or off', () => page.xray()],
    ['l', 'l, L', 'next, previous look of surfaces', () => page.next('style', 1)],
    ['L', '', '', () => page.next('style', -1)],
    ['p', 'p, P', 'next, previous preset', () => page.next('preset', 1)],
    ['P', '', '', () => page.next('preset', -1)],
    ['Backspace', 'backspace', 'plain lines: as at the beginning', () => page.reset()],
    ['s', 's, S', 'save the picture as PNG, its lines as SVG', () => by_id('save-png').click()],
    ['S', '', '', () => by_id('save-svg').click()],
    ['c C', 'c', 'copy the command line that draws it', () => by_id('copy-command').click()],
    ['?', '?', 'this help', () => page.help()],
];

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/* Does a control that is being used want the keys for itself? */
function is_taken(event) {
    const at = event.target;
    if (document.querySelector('dialog[open]')) return true;
    return at !== document.body && at !== document.documentElement && at.id !== 'picture';
}

const writes = (event) => /^(INPUT|TEXTAREA)$/.test(event.target.tagName) && !/^(checkbox|range|color)$/.test(event.target.type);

function undo_key(app, event) {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || writes(event)) return false;
    if (key === 'z') app.travel(event.shiftKey ? 1 : -1);
    else if (key === 'y' && !event.shiftKey) app.travel(1);
    else return false;
    return true;
}

export function bind_keys(app, page) {
    const rows = table(app, page);
    const acts = new Map(rows.flatMap(([keys, , , act]) => keys.split(' ').map((key) => [key, act])));
    const letters = by_id('letter-keys');
    letters.checked = recall('letter-keys', true);
    on(letters, 'change', () => remember('letter-keys', letters.checked));
    by_id('key-list').append(
        ...rows.filter(([, name]) => name).flatMap(([, name, about]) => [make('dt', {}, name), make('dd', {}, about)]),
        make('dt', {}, `${control} + z, shift + ${control} + z`), make('dd', {}, 'undo, redo'),
        make('dt', {}, `${control} + o`), make('dd', {}, 'open files'),
    );
    on(window, 'keydown', (event) => {
        if (!app.engine || event.defaultPrevented || event.isComposing) return;
        if (undo_key(app, event)) return event.preventDefault();
        if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'o' && !event.shiftKey && !event.altKey) {
            by_id('open').click();
            return event.preventDefault();
        }
        if (event.ctrlKey || event.metaKey || event.altKey || is_taken(event)) return;
        const arrow = arrows[event.key];
        const act = acts.get(event.key);
        if (arrow) app.step(arrow[0], arrow[1], event.shiftKey);
        else if (act && event.key.length === 1 && !letters.checked && event.target.id !== 'picture') return;
        else if (act) act();
        else return;
        event.preventDefault();
    });
}

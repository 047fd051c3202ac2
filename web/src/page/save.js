/* Saving: pictures of any size, and the lines as paths, drawn apart from what is on the screen. */
import { by_id, on } from './dom.js';
import { reason, say, tell } from './messages.js';
import { recall, remember } from './store.js';

const papers = { a4: [3508, 2480], a3: [4961, 3508] }; /* px at 300 dpi, wide */
const most = 16384; /* px */

let saving = false;

/* The drawing's size on the screen, in pixels of the screen. */
let screen_size = [1, 1];

/** Tells how large the drawing is on the screen. */
export function set_screen_size(width, height) {
    screen_size = [width, height];
    show_size();
}

/* Numbers of the chosen size; pages lie as the drawing does. */
function show_size() {
    const choice = by_id('size-preset').value;
    if (choice === 'own') return;
    const wide = screen_size[0] >= screen_size[1];
    const page = papers[choice];
    const [width, height] = page ? (wide ? page : [page[1], page[0]]) : screen_size.map((px) => Math.min(px * Number(choice), most));
    by_id('size-width').value = String(width);
    by_id('size-height').value = String(height);
}

function wanted_size() {
    const fields = [by_id('size-width'), by_id('size-height')];
    const wrong = fields.find((field) => !field.checkValidity() || !field.value);
    if (wrong) {
        wrong.focus();
        tell(`Width and height are whole numbers of pixels, from 1 to ${most}.`, 'error');
        return null;
    }
    return { width: fields[0].valueAsNumber, height: fields[1].valueAsNumber };
}

function download(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/* The model's name without folder and ending, as a file's name. */
const base_of = (app) => {
    const name = app.model?.shape ?? app.state.model?.name ?? 'drawing';
    return name.replace(/^.*[/\\]/, '').replace(/\.[^.]*$/, '').replace(/[:*?"<>|]/g, '-') || 'drawing';
};

async function save(app, kind) {
    if (!app.engine || saving) return;
    const size = wanted_size();
    if (!size) return;
    saving = true;
    by_id('part-save').setAttribute('aria-busy', 'true');
    try {
        const blob = await app.engine.save(kind, size);
        download(blob, `${base_of(app)}.${kind}`);
        say(`Saved as ${kind.toUpperCase()}`);
    } catch (error) {
        if (!error.stopped) tell(`${kind.toUpperCase()}: ${reason(error)}`, 'error');
    } finally {
        saving = false;
        by_id('part-save').removeAttribute('aria-busy');
    }
}

export function bind_save(app) {
    const choice = by_id('size-preset');
    const kept = recall('size', '1');
    if ([...choice.options].some((option) => option.value === kept && kept !== 'own')) choice.value = kept;
    on(choice, 'change', () => {
        remember('size', choice.value);
        show_size();
    });
    for (const id of ['size-width', 'size-height']) {
        on(by_id(id), 'input', () => {
            choice.value = 'own';
        });
    }
    for (const button of document.querySelectorAll('[data-save]')) on(button, 'click', () => save(app, button.dataset.save));
    const more = by_id('save-more');
    on(more, 'change', () => {
        if (more.value) save(app, more.value);
        more.value = '';
    });
}

/* The page: builds its controls at once, asks for the engine, and shows the first drawing as soon as that can draw. */
import { Engine } from '../engine/engine.js';
import { App } from './app.js';
import { by_id, on } from './dom.js';
import { bind_files } from './files.js';
import { bind_frame, bind_help, bind_progress, bind_theme } from './frame.js';
import { bind_keys } from './keys.js';
import { read_link, without_camera, write_link } from './link.js';
import { reason, tell } from './messages.js';
import { missing_need, show_fatal } from './needs.js';
import { register_offline } from './offline.js';
import { bind_panel, copy, fill_panel, panel_keys } from './panel.js';
import { bind_pointer } from './pointer.js';
import { preload_engine } from './preload.js';
import { bind_save, set_screen_size } from './save.js';
import { recall, remember } from './store.js';

const first_shape = 'bolt';
const largest = 4096; /* px of a side that is drawn on the screen */

const app = new App();

/* ------- size ------- */

/* The drawing has the pixels of the screen that it covers. */
function bind_size() {
    const sheet = by_id('sheet');
    const fit = () => {
        const box = sheet.getBoundingClientRect();
        const scale = Math.min(devicePixelRatio || 1, largest / Math.max(box.width, box.height, 1));
        const width = Math.max(1, Math.round(box.width * scale));
        const height = Math.max(1, Math.round(box.height * scale));
        set_screen_size(width, height);
        app.resize(width, height);
    };
    let frame = 0;
    new ResizeObserver(() => {
        frame ||= requestAnimationFrame(() => {
            frame = 0;
            fit();
        });
    }).observe(sheet);
    fit();
}

/* ------- link and memory ------- */

let written = '';
let timer = 0;

const shape_now = () => app.model?.shape ?? null;

/* The address follows what is seen, so that a page that is loaded again shows it; and so does the memory. */
function follow() {
    clearTimeout(timer);
    timer = setTimeout(() => {
        if (!app.model || !app.state.model) return;
        const hash = write_link(shape_now(), app.state.options);
        remember('last', { shape: shape_now() ?? first_shape, text: without_camera(app.state.options) });
        if (hash === written || (hash === `shape=${first_shape}` && !location.hash)) return;
        written = hash;
        try {
            history.replaceState(null, '', `#${hash}`);
        } catch {
            /* too many changes for this browser: the next one is written */
        }
    }, 250);
}

async function copy_link() {
    const address = new URL(location.href);
    address.hash = write_link(shape_now(), app.state.options);
    const done = await copy(address.href);
    if (!done) return tell('The browser let nothing be copied; the link is in its address bar.', 'warning');
    tell(shape_now() ? 'The link is copied.' : 'The link is copied. It holds all but the model: whoever opens it adds the file.', 'note');
}

/* Options of a link whose model is a file wait for the file. */
let pending = null;

/** Shows what a link says; what makes no sense in it is told and left out. */
async function show_link(link) {
    if (link.wrong) tell(link.wrong, 'error');
    const shape = link.shape ?? first_shape;
    const known = app.engine.shapes.some(({ name }) => name === shape.split(':')[0]);
    if (!known) tell(`The link names a shape that Drypoint does not have: ${shape}`, 'error');
    let text = known ? link.text : null;
    if (text !== null && !link.shape) {
        pending = text;
        text = without_camera(text);
        tell('The link was made with a file, which it does not hold. Open that file, and it is drawn as in the link.', 'note');
    }
    return show(known ? shape : first_shape, text ?? '');
}

async function show(shape, text, quiet = false) {
    if (text) await app.restore(text, { quiet });
    if (await app.open({ shape })) return text ? app.restore(text, { quiet: true }) : true;
    return shape !== first_shape && app.open({ shape: first_shape });
}

async function show_first() {
    const link = read_link(location.hash);
    if (link.shape !== null || link.text !== null || link.wrong) return show_link(link);
    const last = recall('last', { shape: first_shape, text: '' });
    const shape = app.engine.shapes.some(({ name }) => name === last.shape) ? last.shape : first_shape;
    return show(shape, typeof last.text === 'string' ? last.text : '', true);
}

/* ------- start ------- */

function bind_all() {
    bind_theme();
    bind_frame();
    bind_panel(app);
    bind_save(app);
    bind_files(app);
    bind_pointer(app);
    const help = bind_help();
    bind_keys(app, { ...panel_keys(app), help, first_view: () => app.view('') });
    on(by_id('link'), 'click', copy_link);
    app.addEventListener('state', follow);
    app.addEventListener('state', () => {
        if (!pending || !app.model?.files) return;
        const text = pending;
        pending = null;
        app.restore(text);
    });
}

function show_hint() {
    if (recall('visited', false)) return;
    remember('visited', true);
    by_id('hint').hidden = false;
    setTimeout(() => {
        by_id('hint').hidden = true;
    }, 12000);
}

async function start() {
    const missing = missing_need();
    if (!missing) preload_engine();
    const created = missing ? null : Engine.create(by_id('picture'));
    created?.catch(() => {}); // told below
    bind_all();
    if (missing) return show_fatal(missing);
    try {
        const engine = await created;
        app.attach(engine);
        window.drypoint = { engine };
        bind_progress(app);
        bind_size();
        fill_panel(app);
        app.addEventListener('frame', () => {
            by_id('waiting').hidden = true;
            show_hint();
        }, { once: true });
        await show_first();
        app.begin_here();
    } catch (error) {
        return show_fatal(`Drypoint could not start: ${reason(error)}`);
    }
    on(window, 'hashchange', () => {
        const link = read_link(location.hash);
        if (location.hash.slice(1) !== written && (link.shape !== null || link.text !== null || link.wrong)) show_link(link);
    });
    register_offline(() => {
        by_id('offline').hidden = false;
    }, (change) => {
        const text = 'A newer version of the page is there. Lines, look and view stay; a file has to be opened again.';
        tell(text, 'note', { label: 'Load it', act: change });
    });
}

start();

/* What surrounds the drawing: panel (a sheet from below on narrow screens), appearance, progress, help. */
import { by_id, make, on } from './dom.js';
import { say } from './messages.js';
import { recall, remember } from './store.js';

/* As in style.css. */
const narrow = matchMedia('(max-width: 520px), (max-width: 760px) and (orientation: portrait)');

/* ------- panel ------- */

function show_shut(open) {
    by_id('panel-inner').hidden = !open;
    document.body.dataset.panel = open ? 'open' : 'closed';
    for (const id of ['panel-toggle', 'grip']) by_id(id).setAttribute('aria-expanded', String(open));
}

/* The command line lies below the drawing; on narrow screens it is part of the sheet. */
function place_command() {
    if (narrow.matches) by_id('part-save').after(by_id('command-line'));
    else by_id('panel').after(by_id('command-line'));
}

export function bind_frame() {
    const open_now = () => document.body.dataset.panel === 'open';
    const toggle = () => {
        show_shut(!open_now());
        if (!narrow.matches) remember('panel', open_now());
    };
    const adapt = () => {
        show_shut(narrow.matches ? false : recall('panel', true));
        place_command();
    };
    on(by_id('panel-toggle'), 'click', toggle);
    on(by_id('grip'), 'click', toggle);
    on(narrow, 'change', adapt);
    adapt();
    for (const part of document.querySelectorAll('.panel-inner > section')) {
        const head = part.querySelector('h2');
        const button = make('button', { type: 'button' }, head.textContent);
        on(button, 'click', () => {
            part.scrollIntoView({ block: 'start' });
            part.querySelector('button, input, select')?.focus({ preventScroll: true });
        });
        by_id('tabs').append(button);
    }
    on(document.querySelector('.skip'), 'click', (event) => {
        event.preventDefault();
        by_id('picture').focus();
    });
}

/* ------- appearance ------- */

export function bind_theme() {
    const choice = by_id('theme');
    const show = () => {
        if (choice.value === 'auto') delete document.documentElement.dataset.theme;
        else document.documentElement.dataset.theme = choice.value;
        const desk = getComputedStyle(document.documentElement).getPropertyValue('--desk').trim();
        if (choice.value !== 'auto') for (const meta of document.querySelectorAll('meta[name=theme-color]')) meta.content = desk;
    };
    const kept = recall('theme', 'auto');
    choice.value = ['light', 'dark'].includes(kept) ? kept : 'auto';
    show();
    on(choice, 'change', () => {
        remember('theme', choice.value);
        show();
    });
}

/* ------- progress ------- */

const patience = 200; /* ms before anything is shown */
const doing = { reading: 'Reading', drawing: 'Drawing', saving: 'Saving' };

export function bind_progress(app) {
    const box = by_id('progress');
    const bar = by_id('progress-bar');
    let timer = 0;
    let shown = '';
    const hide = () => {
        clearTimeout(timer);
        timer = 0;
        shown = '';
        box.hidden = true;
    };
    on(by_id('cancel'), 'click', () => app.cancel());
    app.engine.addEventListener('idle', hide);
    app.engine.addEventListener('progress', ({ detail }) => {
        if (detail.fraction < 0 || !Number.isFinite(detail.fraction)) bar.removeAttribute('value');
        else bar.value = Math.min(detail.fraction, 1);
        by_id('progress-text').textContent = detail.what === 'reading' ? `Reading ${app.opening}` : (doing[detail.what] ?? detail.what);
        timer ||= setTimeout(() => {
            box.hidden = false;
            if (shown !== detail.what) say(doing[detail.what] ?? detail.what);
            shown = detail.what;
        }, patience);
    });
}

/* ------- help ------- */

export function bind_help() {
    const dialog = by_id('help');
    const open = () => {
        if (dialog.open) return dialog.close();
        dialog.showModal();
        by_id('help-body').scrollTop = 0;
    };
    on(by_id('help-open'), 'click', open);
    on(by_id('help-close'), 'click', () => dialog.close());
    on(dialog, 'click', (event) => {
        if (event.target === dialog) dialog.close(); // beside the box
    });
    return open;
}

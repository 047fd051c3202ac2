/* The side panel: choices and colours, what is seen of the model, the command line. Controls show what the picture is
 * drawn with (presets and defaults taken in), whoever changed it. */
import { by_id, choose, fill, is_edited, make, on } from './dom.js';
import { hex_of, value_of } from './effective.js';
import { bind_galleries, complete_galleries, show_galleries } from './galleries.js';
import { all_widths, bind_lines, show_lines, step_angle } from './lines.js';
import { camera_names } from './link.js';
import { say, tell } from './messages.js';
import { label_of, pairs_of, words_of } from './words.js';

/* Choices whose words are those of an option: [id and option, its usual word]. */
const choices = [['style', 'flat'], ['hidden', 'none'], ['detail', 'auto'], ['smooth', 'off']];

const xray_text = (value) => (value > 0 && value < 1 ? `${Math.round(100 * (1 - value))} %` : 'off');

const seconds = (time) => `${time.toFixed(2)} s`;

/* A slider that says how much shines through, where the option says how much does not. */
const xray_option = (through) => (through > 0 ? (1 - through).toFixed(2) : null);

/* ------- before the engine is there ------- */

export function bind_panel(app) {
    bind_galleries(app);
    bind_lines(app);
    for (const [name] of choices) on(by_id(name), 'change', (event) => app.set({ [name]: event.target.value }));
    on(by_id('up'), 'change', (event) => app.set({ up: event.target.value || null }));
    on(by_id('preset'), 'change', (event) => app.set_preset(event.target.value));
    for (const name of ['stroke', 'clip']) on(by_id(name), 'change', (event) => app.set({ [name]: event.target.value || null }));
    on(by_id('time'), 'input', (event) => {
        by_id('time-out').textContent = seconds(event.target.valueAsNumber);
        app.set({ time: event.target.value }, 'time');
    });
    for (const name of ['paper', 'surface']) on(by_id(name), 'input', (event) => app.set({ [name]: event.target.value }, name));
    on(by_id('xray'), 'input', (event) => {
        const value = xray_option(event.target.valueAsNumber);
        by_id('xray-out').textContent = xray_text(Number(value));
        app.set({ xray: value }, 'xray');
    });
    on(by_id('ortho'), 'change', (event) => app.project(event.target.checked));
    on(by_id('fit'), 'click', () => app.fit());
    on(by_id('reset'), 'click', () => reset(app));
    for (const button of document.querySelectorAll('[data-view]')) on(button, 'click', () => app.view(button.dataset.view));
    on(by_id('undo'), 'click', () => app.travel(-1));
    on(by_id('redo'), 'click', () => app.travel(1));
    on(by_id('options-form'), 'submit', (event) => {
        event.preventDefault();
        app.restore(by_id('options').value.trim());
    });
    on(by_id('option-list'), 'change', () => show_option(app));
    on(by_id('copy-command'), 'click', async () => {
        tell((await copy(app.state.command)) ? 'The command line is copied.' : 'The browser let nothing be copied.', 'note');
    });
    app.addEventListener('state', () => show_panel(app));
    app.addEventListener('frame', (event) => show_figures(event.detail));
}

export async function copy(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return copy_by_field(text);
    }
}

/* Where pages that are not served safely may not use the clipboard. */
function copy_by_field(text) {
    const field = make('textarea', { class: 'unseen', 'aria-hidden': 'true' });
    const held = document.activeElement;
    field.value = text;
    document.body.append(field);
    field.select();
    const done = document.execCommand('copy');
    field.remove();
    held?.focus();
    return done;
}

/* ------- once the engine knows its options ------- */

export function fill_panel(app) {
    const { engine } = app;
    for (const [name] of choices) fill(by_id(name), pairs_of(engine, name));
    fill(by_id('preset'), [['', 'none'], ...engine.presets.map(({ name }) => [name, label_of('preset', name)])]);
    fill(by_id('stroke'), [['', 'plain ink'], ...engine.textures.map(({ name }) => [name, name])]);
    fill(by_id('up'), [['', 'as in the file'], ...words_of(engine, 'up').map((word) => [word, word])]);
    const groups = new Map();
    for (const option of engine.options) groups.set(option.groupName, [...(groups.get(option.groupName) ?? []), option.name]);
    by_id('option-list').replaceChildren(
        new Option('…', ''),
        ...[...groups].map(([label, names]) => make('optgroup', { label }, ...names.map((name) => new Option(`--${name}`, name)))),
    );
    by_id('about-program').textContent = `Drypoint ${engine.info.version}`;
    complete_galleries(app);
}

function show_option(app) {
    const option = app.engine?.options.find((each) => each.name === by_id('option-list').value);
    const text = by_id('option-help');
    text.hidden = !option;
    if (!option) return;
    const call = `--${option.name}${option.argument ? ` ${option.argument}` : ''}`;
    text.replaceChildren(make('code', {}, call), ` ${option.help}`);
}

/* ------- what is ------- */

const number_text = (count) => count.toLocaleString('en').replaceAll(',', ' ');

function show_model(app) {
    const { model } = app.state;
    const name = (model?.name ?? '').replace(/^shape:/, '');
    by_id('model-name').textContent = name;
    by_id('model-size').textContent = model ? `${number_text(model.polygons)} polygons` : '';
    document.title = model ? `${name} – Drypoint` : 'Drypoint';
    by_id('picture').setAttribute('aria-label', model ? `Drawing of ${name}` : 'Drawing');
    const remark = by_id('model-remark');
    remark.hidden = !model?.remark;
    remark.textContent = model?.remark ?? '';
    const { up } = app.state.words;
    by_id('up').options[0].textContent = model?.up && !up ? `${model.up}, ${model.upAssumed ? 'assumed' : 'as in the file'}` : 'as in the file';
    by_id('up').value = up ?? '';
}

/* Models that move: at which time they are seen. */
function show_time(app) {
    const { moves, time = 0, duration } = app.state.effective ?? {};
    by_id('time-row').hidden = !moves;
    by_id('time').max = String(duration > 0 ? duration : 10);
    if (!is_edited(by_id('time'))) by_id('time').value = String(time);
    by_id('time-out').textContent = seconds(time);
}

function show_choices(app) {
    const { state } = app;
    for (const [name, usual] of choices) {
        const word = String(value_of(state, name, usual));
        choose(by_id(name), word, label_of(name, word));
    }
    choose(by_id('preset'), state.words.preset ?? '', label_of('preset', state.words.preset ?? 'none'));
    choose(by_id('stroke'), value_of(state, 'stroke', '') || '');
    choose(by_id('clip'), state.words.clip ?? '');
    if (state.words.up) choose(by_id('up'), state.words.up);
    by_id('ortho').checked = Boolean(value_of(state, 'orthographic', false));
    for (const name of ['paper', 'surface']) by_id(name).value = hex_of(value_of(state, name)) ?? '#ffffff';
    const xray = Number(value_of(state, 'xray', 0));
    if (!is_edited(by_id('xray'))) by_id('xray').value = String(xray > 0 ? 1 - xray : 0);
    by_id('xray-out').textContent = xray_text(xray);
}

export function show_panel(app) {
    show_model(app);
    show_time(app);
    show_choices(app);
    show_lines(app);
    show_galleries(app);
    by_id('command').textContent = app.state.command;
    if (!is_edited(by_id('options'))) by_id('options').value = app.state.options;
    by_id('undo').disabled = !app.history.can_undo;
    by_id('redo').disabled = !app.history.can_redo;
}

function show_figures({ ms, segments, full }) {
    if (full) by_id('figures').textContent = `${number_text(segments)} segments, ${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`;
}

/* ------- what keys do ------- */

export function reset(app) {
    const stay = new Set([...camera_names, 'up', 'time']);
    const names = Object.keys(app.state.words).filter((name) => !stay.has(name));
    app.set(Object.fromEntries(names.map((name) => [name, null])));
    say('Plain lines');
}

/** What the table of keys asks of the panel. */
export const panel_keys = (app) => ({
    orthographic: () => by_id('ortho').checked,
    widths: (step) => all_widths(app, step),
    angle: (name, degrees) => step_angle(app, name, degrees),
    reset: () => reset(app),
    xray() {
        const now = Number(value_of(app.state, 'xray', 0)) > 0;
        app.set({ xray: now ? null : '0.3' });
        say(now ? 'Surfaces are opaque' : 'Surfaces are see-through');
    },
    next(id, step) {
        const select = by_id(id);
        const { options } = select;
        select.selectedIndex = (select.selectedIndex + step + options.length) % options.length;
        select.dispatchEvent(new Event('change'));
        say(`${select.labels[0].textContent}: ${options[select.selectedIndex].textContent}`);
    },
});

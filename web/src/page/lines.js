/* The controls of lines: a row for each class, with switch, colour and width, and the angles of creases. */
import { by_id, is_edited, make, on } from './dom.js';
import { hex_of, line_of, value_of } from './effective.js';
import { say } from './messages.js';
import { all_classes, digits, line_classes, with_piece } from './words.js';

const thinnest = 0.5;
const widest = 64;

const clamp = (value, least, most) => Math.min(Math.max(value, least), most);
const is_on = (app, name) => line_of(app.state, name).on;

function set_class(app, name, on_now) {
    const drawn = all_classes.filter((each) => (each === name ? on_now : is_on(app, each)));
    const all = drawn.length === all_classes.length;
    // a preset may leave classes out, so that `all` has to be said beside one
    app.set({ lines: all ? ('preset' in app.state.words ? 'all' : null) : drawn.join(',') || 'none' });
}

function set_width(app, name, px) {
    if (!(px > 0)) return;
    app.set({ width: with_piece(app.state.words.width, name, digits(clamp(px, thinnest, widest), 3)) }, `width ${name}`);
}

/* Arrows step by tenths of a pixel, with shift by whole ones. */
function step_width(app, name, field, event) {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const px = clamp(Math.round(10 * field.valueAsNumber + way * (event.shiftKey ? 10 : 1)) / 10, thinnest, widest);
    if (!(px > 0)) return;
    field.value = digits(px, 3);
    set_width(app, name, px);
}

function row_of(app, [name, label]) {
    const row = make('div', { class: 'line', 'data-line': name, role: 'group', 'aria-label': label });
    const toggle = make('input', { type: 'checkbox', role: 'switch', class: 'switch', id: `line-${name}`, checked: true });
    const text = make('label', { for: `line-${name}` }, label);
    const width = make('input', {
        type: 'number', class: 'width', min: thinnest, max: widest, step: 'any', inputmode: 'decimal',
        'aria-label': `Width of ${label.toLowerCase()} in pixels`, title: 'Width in pixels',
    });
    const color = make('input', { type: 'color', class: 'color', value: '#000000', 'aria-label': `Colour of ${label.toLowerCase()}`, title: 'Colour' });
    on(toggle, 'change', () => set_class(app, name, toggle.checked));
    on(width, 'input', () => width.validity.valid && set_width(app, name, width.valueAsNumber));
    on(width, 'change', () => set_width(app, name, width.valueAsNumber));
    on(width, 'keydown', (event) => step_width(app, name, width, event));
    on(color, 'input', () => app.set({ color: with_piece(app.state.words.color, name, color.value) }, `color ${name}`));
    row.append(toggle, text, width, color);
    return row;
}

/** All classes wider (step 1) or narrower (-1), as they look now. */
export function all_widths(app, step) {
    const factor = step > 0 ? 1.25 : 1 / 1.25;
    const wide = all_classes.map((name) => {
        const now = line_of(app.state, name).width;
        return `${name}=${digits(clamp(now * factor, thinnest, widest), 3)}`;
    });
    app.set({ width: wide.join(',') }, 'widths');
    say(step > 0 ? 'Wider lines' : 'Narrower lines');
}

const angles = { 'ridge-angle': ['ridgeAngle', 150], 'valley-angle': ['valleyAngle', 210] };

const angle_of = (app, name) => Number(value_of(app.state, ...angles[name]));

export function step_angle(app, name, degrees) {
    const angle = clamp(Math.round(angle_of(app, name)) + degrees, 1, 359);
    app.set({ [name]: String(angle) }, name);
    say(`${name === 'ridge-angle' ? 'Ridges up to' : 'Valleys from'} ${angle} degrees`);
}

export function bind_lines(app) {
    by_id('lines').append(...line_classes.map((each) => row_of(app, each)));
    on(by_id('thinner'), 'click', () => all_widths(app, -1));
    on(by_id('wider'), 'click', () => all_widths(app, 1));
    for (const name of Object.keys(angles)) {
        const range = by_id(name);
        on(range, 'input', () => {
            by_id(`${name}-out`).textContent = `${range.value}°`;
            app.set({ [name]: range.value }, name);
        });
    }
}

export function show_lines(app) {
    for (const [name] of line_classes) {
        const row = document.querySelector(`.line[data-line=${name}]`);
        const now = line_of(app.state, name);
        const [toggle, , width, color] = row.children;
        toggle.checked = now.on;
        row.classList.toggle('off', !now.on);
        if (!is_edited(width)) width.value = digits(now.width, 2 + (now.width >= 10));
        color.value = hex_of(now.color) ?? '#000000';
    }
    for (const name of Object.keys(angles)) {
        const now = angle_of(app, name);
        if (!is_edited(by_id(name))) by_id(name).value = String(now);
        by_id(`${name}-out`).textContent = `${digits(now)}°`;
    }
}

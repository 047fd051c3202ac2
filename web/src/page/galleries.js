/* The two galleries: models that the program generates, and looks. Their small pictures were drawn by it. */
import { by_id, make, on } from './dom.js';
import { label_of } from './words.js';

/* In the order of the shelf; what the program has beyond these follows. */
const shapes = ['bolt', 'gear', 'bracket', 'stairs', 'boxes', 'torus', 'cube', 'tetrahedron', 'cylinder', 'sphere', 'flag', 'torso', 'terrain'];
/* Presets that look different on a screen. Those for offices and machines are in the choice below them. */
const looks = ['', 'technical', 'illustration', 'cartoon', 'engraving', 'blueprint', 'sketch', 'pencil', 'patent'];

function card(folder, name, label, title) {
    const picture = make('img', { src: `icons/${folder}/${name}.webp`, alt: '', width: 88, height: 66, decoding: 'async', draggable: 'false' });
    return make('button', { type: 'button', class: 'card', 'data-name': name, 'aria-pressed': 'false', title }, picture, make('span', {}, label));
}

/** Builds both; before the engine is there, as what they hold is known. */
export function bind_galleries(app) {
    for (const name of shapes) {
        const button = card('shapes', name, name, null);
        on(button, 'click', () => app.engine && app.open({ shape: name }));
        by_id('gallery').append(button);
    }
    for (const name of looks) {
        const button = card('looks', name || 'none', name ? label_of('preset', name) : 'plain', null);
        button.dataset.name = name;
        on(button, 'click', () => app.engine && app.set_preset(name));
        by_id('looks').append(button);
    }
}

/** What the program has and the shelf has not, and what it says about each. */
export function complete_galleries(app) {
    const gallery = by_id('gallery');
    for (const { name, about } of app.engine.shapes) {
        let button = gallery.querySelector(`[data-name="${name}"]`);
        if (!button) {
            button = make('button', { type: 'button', class: 'card bare', 'data-name': name, 'aria-pressed': 'false' }, make('span', {}, name));
            on(button, 'click', () => app.open({ shape: name }));
            gallery.append(button);
        }
        button.title = about;
    }
    const known = new Set(app.engine.shapes.map((shape) => shape.name));
    for (const button of [...gallery.children]) if (!known.has(button.dataset.name)) button.remove();
}

export function show_galleries(app) {
    const shape = app.model?.shape?.split(':')[0] ?? '';
    const preset = app.state.words.preset ?? '';
    for (const button of by_id('gallery').children) button.setAttribute('aria-pressed', String(button.dataset.name === shape));
    for (const button of by_id('looks').children) button.setAttribute('aria-pressed', String(button.dataset.name === preset));
}

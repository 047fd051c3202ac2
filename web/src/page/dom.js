/* Short names for what the page does to its document. */

/** @param {string} id @returns {any} */
export const by_id = (id) => document.getElementById(id);

/** Calls `act` when one of the events happens to the target. */
export function on(target, events, act, options) {
    for (const event of events.split(' ')) target.addEventListener(event, act, options);
}

/** An element with attributes and content: strings and elements. */
export function make(tag, attributes = {}, ...content) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value === true) element.setAttribute(name, '');
        else if (value !== false && value !== null) element.setAttribute(name, value);
    }
    element.append(...content);
    return element;
}

const svg_space = 'http://www.w3.org/2000/svg';

/** One of the icons that index.html holds. */
export function icon(name) {
    const picture = document.createElementNS(svg_space, 'svg');
    const use = document.createElementNS(svg_space, 'use');
    picture.setAttribute('class', 'icon');
    picture.setAttribute('aria-hidden', 'true');
    use.setAttribute('href', `#i-${name}`);
    picture.append(use);
    return picture;
}

/** Fills a choice: [[value, label], ...]; what was chosen stays so if it is there. */
export function fill(select, pairs) {
    const now = select.value;
    select.replaceChildren(...pairs.map(([value, label]) => new Option(label, value)));
    if (pairs.some(([value]) => value === now)) select.value = now;
}

/** Shows a value in a choice, added to it if it is none of its own. */
export function choose(select, value, label = value) {
    if (![...select.options].some((option) => option.value === value)) select.append(new Option(label, value));
    if (select.value !== value) select.value = value;
}

/** Is the element being written into now? Then its value is the writer's. */
export const is_edited = (element) => document.activeElement === element;

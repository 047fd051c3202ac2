/* What the page tells: messages that are seen, and announcements that are heard.
 *
 * Errors and warnings stay until they are dismissed; notes go by themselves unless they are pointed at. Announcements
 * are for screen readers, which would be flooded by every step of a turn: only the last within `pause` is said. */
import { by_id, icon, make, on } from './dom.js';

const note_stays = 7000; /* ms */
const pause = 500; /* ms */
const most = 5; /* messages at a time */

function leave_in_time(box) {
    let timer = 0;
    const wait = () => {
        timer = setTimeout(() => box.remove(), note_stays);
    };
    on(box, 'pointerenter focusin', () => clearTimeout(timer));
    on(box, 'pointerleave focusout', wait);
    wait();
}

function dismiss(box) {
    const next = box.nextElementSibling ?? box.previousElementSibling;
    const held = box.contains(document.activeElement);
    box.remove();
    if (held) (next?.querySelector('button') ?? by_id('picture')).focus();
}

/** Shows a message. kind: 'error', 'warning' or 'note'; `offer` is a button: {label, act}. */
export function tell(text, kind = 'note', offer = null) {
    const list = by_id('messages');
    const same = [...list.children].find((box) => box.firstElementChild.textContent === text);
    same?.remove();
    const box = make('div', { class: `message ${kind}`, role: kind === 'error' ? 'alert' : null }, make('p', {}, text));
    const close = make('button', { type: 'button', class: 'square', 'aria-label': 'Dismiss' }, icon('close'));
    on(close, 'click', () => dismiss(box));
    if (offer) {
        const button = make('button', { type: 'button', class: 'offer' }, offer.label);
        on(button, 'click', offer.act);
        box.append(button);
    }
    box.append(close);
    const notes = list.querySelectorAll('.note');
    if (list.children.length >= most) (notes[0] ?? list.children[0]).remove();
    list.append(box);
    if (kind === 'note' && !offer) leave_in_time(box);
}

/** The text of what was thrown. */
export const reason = (thrown) => (thrown instanceof Error ? thrown.message : String(thrown)) || 'something went wrong';

let said = 0;

/** Has a screen reader say something, unless it has something newer to say within `pause`. */
export function say(text) {
    clearTimeout(said);
    said = setTimeout(() => {
        by_id('say').textContent = text;
    }, pause);
}

/* What a camera has done since it was announced: it adds up until it rests. */
const moved = { right: 0, down: 0, pan_right: 0, pan_down: 0, zoom: 1 };
let rest = 0;

const turn_text = (amount, more, less, unit) =>
    Math.abs(amount) < 0.5 ? [] : [`${amount > 0 ? more : less}, ${Math.round(Math.abs(amount))} ${unit}`];

function say_moves() {
    const parts = [
        ...turn_text(moved.right, 'turned right', 'turned left', 'degrees'),
        ...turn_text(moved.down, 'turned down', 'turned up', 'degrees'),
        ...turn_text(moved.pan_right * 100, 'moved right', 'moved left', 'percent'),
        ...turn_text(moved.pan_down * 100, 'moved down', 'moved up', 'percent'),
    ];
    if (Math.abs(Math.log(moved.zoom)) > 0.005) {
        parts.push(`${moved.zoom > 1 ? 'nearer' : 'farther'}, ${Math.round(100 * moved.zoom)} percent`);
    }
    Object.assign(moved, { right: 0, down: 0, pan_right: 0, pan_down: 0, zoom: 1 });
    if (parts.length) by_id('say').textContent = parts.join('; ');
}

/** Notes a move of the camera, in degrees and shares of the picture's height; it is announced once the camera rests. */
export function say_move({ right = 0, down = 0, pan_right = 0, pan_down = 0, zoom = 1 }) {
    moved.right += right;
    moved.down += down;
    moved.pan_right += pan_right;
    moved.pan_down += pan_down;
    moved.zoom *= zoom;
    clearTimeout(rest);
    rest = setTimeout(say_moves, pause);
}

/* What was seen before: a list of moments, each a text (options and camera) and what was drawn, and a place in it.
 *
 * Invariant: moments[place] is what is seen now. Moments that follow each other within `pause` and come from one thing
 * being moved (a slider, the camera) are one. */

const most = 200; /* moments */
const pause = 700; /* ms */

export class History {
    moments = [];
    place = -1;
    #last = -Infinity;
    #what = '';

    /** Takes what is seen now. `what` names what was moved; `now` is a time in ms. */
    push(text, model, what, now) {
        const present = this.moments[this.place];
        if (present && present.text === text && present.model === model) return false;
        const goes_on = what !== '' && what === this.#what && now - this.#last < pause && this.place > 0;
        this.#last = now;
        this.#what = what;
        this.moments.length = this.place + 1;
        if (goes_on && present.model === model) this.moments.pop();
        this.moments.push({ text, model });
        if (this.moments.length > most) this.moments.shift();
        this.place = this.moments.length - 1;
        return true;
    }

    /** Forgets all but what is seen now. */
    begin_here() {
        this.moments = this.moments.slice(this.place, this.place + 1);
        this.place = this.moments.length - 1;
    }

    /** Corrects the present moment: the engine writes a text in its own way. */
    settle(text) {
        if (this.moments[this.place]) this.moments[this.place].text = text;
    }

    get can_undo() {
        return this.place > 0;
    }

    get can_redo() {
        return this.place + 1 < this.moments.length;
    }

    /** The moment that many steps on (back: -1), or null. go() makes it the present one. */
    at(step) {
        return this.moments[this.place + step] ?? null;
    }

    go(step) {
        if (!this.moments[this.place + step]) return;
        this.place += step;
        this.#what = '';
    }
}

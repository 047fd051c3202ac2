/* What the page does: every control, key and gesture ends in a method of App, which asks the engine.
 *
 * The page's only state is the engine's: a command line. App keeps its last `state` event, and what was opened. Of
 * changes that come faster than the engine takes them the newest of each option wins. `ready` is what the document
 * says: the full picture of the present state is on the canvas. */
import { History } from './history.js';
import { reason, say, say_move, tell } from './messages.js';

const camera_step = 5 / 180; /* of a picture's height: five degrees */

export class App extends EventTarget {
    engine = null;
    state = { command: 'drypoint', options: '', words: {}, effective: {}, model: null };
    history = new History();
    model = null; /* {shape} or {files}: what was opened */
    opening = ''; /* the name of what is being opened */
    #waiting = null; /* options to be set */
    #setting = false;
    #asked = 0; /* calls that the engine has not answered */
    #full = false; /* the last frame was a full picture, and nothing was asked for since */
    #travels = false;
    #trip = Promise.resolve(); /* through history */
    #opens = 0; /* models that are being opened */
    #what = '';

    attach(engine) {
        this.engine = engine;
        engine.addEventListener('state', (event) => this.#on_state(event.detail));
        engine.addEventListener('frame', (event) => this.#on_frame(event.detail));
        engine.addEventListener('message', (event) => tell(event.detail.text, event.detail.kind));
    }

    #on_state(detail) {
        this.state = detail;
        if (this.model && !this.#travels && !this.#opens) this.history.push(detail.options, this.model, this.#what, performance.now());
        this.dispatchEvent(new CustomEvent('state', { detail }));
    }

    #on_frame(detail) {
        this.#full = detail.full || Boolean(detail.cancelled); // what was cancelled is not drawn again
        this.#mark(this.#full && this.#asked === 0 ? 'ready' : 'drawing');
        if (detail.cancelled) return;
        this.dispatchEvent(new CustomEvent('frame', { detail }));
    }

    #mark(state) {
        const root = document.documentElement;
        if (root.dataset.state === 'loading') {
            if (state !== 'ready') return; // until there is a first picture
            performance.mark('first-picture');
        }
        root.dataset.state = state;
    }

    /* Asks the engine for something that changes the picture. What fails changes nothing. */
    async #ask(call) {
        const before = this.#full;
        this.#asked++;
        this.#full = false;
        this.#mark('drawing');
        try {
            return await call();
        } catch (error) {
            this.#full ||= before;
            throw error;
        } finally {
            this.#asked--;
            if (this.#asked === 0 && this.#full) this.#mark('ready');
        }
    }

    /* ------- options ------- */

    /** Sets options: {name: value, '' for flags, null takes away}. `what` names the control: its steps undo as one. */
    set(options, what = '') {
        this.#waiting = { ...this.#waiting, ...options };
        this.#what = what;
        if (!this.#setting) this.#flush();
    }

    async #flush() {
        this.#setting = true;
        while (this.#waiting) {
            const options = this.#waiting;
            this.#waiting = null;
            try {
                await this.#ask(() => this.engine.set(options));
            } catch (error) {
                if (!error.stopped) tell(reason(error), 'error');
                this.#refused();
            }
        }
        this.#setting = false;
    }

    /* Nothing changed: controls show again what is. */
    #refused() {
        this.dispatchEvent(new CustomEvent('state', { detail: this.state }));
    }

    /** A preset takes the place of what was set of lines and looks (the engine sees to that), and of the colours. */
    set_preset(name) {
        this.set({ preset: name || null, paper: null, surface: null });
        say(name ? `Preset: ${name}` : 'No preset');
    }

    /** Options and camera as a text; false: it was refused, and a message says why. */
    async restore(text, { quiet = false } = {}) {
        this.#what = '';
        try {
            await this.#ask(() => this.engine.restore(text));
            return true;
        } catch (error) {
            if (!quiet && !error.stopped) tell(reason(error), 'error');
            this.#refused();
            return false;
        }
    }

    /* ------- models ------- */

    /** Opens {shape} or {files}. False: it failed, what was there stays, and a message says why. */
    async open(model) {
        this.#what = '';
        this.#opens++;
        this.opening = model.shape ?? model.files[0].name;
        try {
            await this.#ask(() => this.engine.open(model));
            this.model = model;
        } catch (error) {
            if (!error.stopped) tell(reason(error), 'error');
            return false;
        } finally {
            this.#opens--;
            this.#on_state(this.state); // of this model, if it is open; and of what is there, if not
        }
        return true;
    }

    cancel() {
        this.engine?.cancel();
        say('Cancelled');
    }

    /* ------- camera ------- */

    #moves(what) {
        this.#what = what;
        this.#full = false;
        this.#mark('drawing');
    }

    turn(right, down) {
        this.#moves('turn');
        this.engine.turn(right, down);
        say_move({ right: right * 180, down: down * 180 });
    }

    pan(right, down) {
        this.#moves('pan');
        this.engine.pan(right, down);
        say_move({ pan_right: right, pan_down: down });
    }

    /** The picture's size, px. */
    async resize(width, height) {
        try {
            await this.#ask(() => this.engine.resize(width, height));
        } catch (error) {
            tell(reason(error), 'error');
        }
    }

    /** Turns and zooms about what is seen at a point from now on; shares of the picture, from its upper left. */
    focus(x, y) {
        this.engine.focus(x, y);
    }

    /** Zooms about a point that lies so many picture heights right of and below the middle. */
    zoom(factor, right = 0, down = 0) {
        this.#moves('zoom');
        this.engine.zoom(factor, right, down);
        say_move({ zoom: factor });
    }

    step(right, down, pans) {
        if (pans) this.pan(right * 0.05, down * 0.05);
        else this.turn(right * camera_step, down * camera_step);
    }

    async #camera(call, text) {
        this.#what = '';
        try {
            await this.#ask(call);
            say(text);
        } catch (error) {
            tell(reason(error), 'error');
            this.#refused();
        }
    }

    fit() {
        this.#camera(() => this.engine.fit(), 'The model fills the picture');
    }

    view(name) {
        this.#camera(() => this.engine.view(name), name ? `View: ${name}` : 'View of the beginning');
    }

    project(orthographic) {
        this.#camera(() => this.engine.project(orthographic), orthographic ? 'Orthographic' : 'In perspective');
    }

    /* ------- undo ------- */

    /** What is seen now is what undo ends at. */
    begin_here() {
        this.history.begin_here();
        this.dispatchEvent(new CustomEvent('state', { detail: this.state }));
    }

    /** Goes that many moments on (back: -1), after those steps that are under way. */
    travel(step) {
        this.#trip = this.#trip.then(() => this.#go(step));
        return this.#trip;
    }

    async #go(step) {
        const moment = this.history.at(step);
        if (!moment) return;
        this.#travels = true;
        let arrived = true;
        if (moment.model !== this.model) arrived = await this.open(moment.model);
        if (arrived) arrived = await this.restore(moment.text);
        if (arrived) {
            this.history.go(step);
            this.history.settle(this.state.options); // as the engine writes it
            say(step < 0 ? 'Undone' : 'Done again');
        }
        this.#travels = false;
        this.dispatchEvent(new CustomEvent('state', { detail: this.state }));
    }
}

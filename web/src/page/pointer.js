/* Mouse, pen and fingers on the drawing: one turns, two move and pinch; shift or another button moves; the wheel zooms
 * to what is below the pointer. Steps within a frame of the screen are one. */
import { by_id, on } from './dom.js';

const wheel_pause = 400; /* ms after which the wheel turns anew */
const wheel_step = 0.0015; /* of a pixel of the wheel, in factors of e */

export function bind_pointer(app) {
    const canvas = by_id('picture');
    const fingers = new Map(); /* pointer's number: {x, y} */
    const steps = { right: 0, down: 0, pan_right: 0, pan_down: 0, zoom: 1, x: 0, y: 0 };
    let frame = 0;
    let pans = false;
    let last_wheel = -Infinity;

    /* Where a point of the window lies, in picture heights from the middle. */
    const place = (x, y) => {
        const box = canvas.getBoundingClientRect();
        return [(x - box.left - box.width / 2) / box.height, (y - box.top - box.height / 2) / box.height];
    };

    /* The model turns about what lies there from now on, so that zooming never passes it. */
    const focus = (x, y) => {
        const box = canvas.getBoundingClientRect();
        app.focus((x - box.left) / box.width, (y - box.top) / box.height);
    };

    const act = () => {
        frame = 0;
        const { right, down, pan_right, pan_down, zoom, x, y } = steps;
        if (right || down) app.turn(right, down);
        if (pan_right || pan_down) app.pan(pan_right, pan_down);
        if (zoom !== 1) app.zoom(zoom, x, y);
        Object.assign(steps, { right: 0, down: 0, pan_right: 0, pan_down: 0, zoom: 1 });
    };
    const soon = () => {
        frame ||= requestAnimationFrame(act);
    };

    const middle = () => {
        const all = [...fingers.values()];
        return {
            x: all.reduce((sum, each) => sum + each.x, 0) / all.length,
            y: all.reduce((sum, each) => sum + each.y, 0) / all.length,
            apart: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0,
        };
    };

    on(canvas, 'pointerdown', (event) => {
        if (event.pointerType === 'mouse' && event.button > 2) return;
        if (!app.engine) return;
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        pans = event.button > 0 || event.shiftKey;
        if (fingers.size === 2) focus(middle().x, middle().y);
        canvas.classList.add('held');
        by_id('hint').hidden = true;
    });
    on(canvas, 'pointermove', (event) => {
        if (!fingers.has(event.pointerId)) return;
        const height = canvas.clientHeight || 1;
        const before = middle();
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const now = middle();
        const right = (now.x - before.x) / height;
        const down = (now.y - before.y) / height;
        if (fingers.size > 1 || pans) {
            steps.pan_right += right;
            steps.pan_down += down;
        } else {
            steps.right += right;
            steps.down += down;
        }
        if (fingers.size > 1 && before.apart > 10 && now.apart > 10) {
            steps.zoom *= now.apart / before.apart;
            [steps.x, steps.y] = place(now.x, now.y);
        }
        soon();
    });
    on(canvas, 'pointerup pointercancel lostpointercapture', (event) => {
        fingers.delete(event.pointerId);
        if (!fingers.size) canvas.classList.remove('held');
    });
    on(canvas, 'contextmenu', (event) => event.preventDefault());
    on(canvas, 'dblclick', () => app.engine && app.fit());
    on(
        canvas,
        'wheel',
        (event) => {
            if (!app.engine) return;
            event.preventDefault();
            if (event.timeStamp - last_wheel > wheel_pause) focus(event.clientX, event.clientY);
            last_wheel = event.timeStamp;
            const unit = event.deltaMode === 1 ? 33 : event.deltaMode === 2 ? 400 : 1; /* lines, pages, pixels */
            const amount = Math.max(-240, Math.min(240, event.deltaY * unit)) * (event.ctrlKey ? 6 : 1);
            steps.zoom *= Math.exp(-amount * wheel_step);
            [steps.x, steps.y] = place(event.clientX, event.clientY);
            soon();
        },
        { passive: false },
    );
}

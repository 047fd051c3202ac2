/* What a browser must have to draw here, and what is said where it lacks that. */

/* A module with one function that splats a lane: valid only where WebAssembly has SIMD. */
const simd_module = new Uint8Array([
    0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11,
]);

/** What is missing, as a sentence; null: nothing. */
export function missing_need() {
    if (location.protocol === 'file:')
        return 'The page has to come from a web server; browsers let no file start what draws. "make serve" is such a server.';
    if (typeof WebAssembly !== 'object') return 'This browser has no WebAssembly, or it is switched off. Drypoint draws with it.';
    if (!WebAssembly.validate(simd_module))
        return 'This browser’s WebAssembly lacks SIMD: Chrome 91, Firefox 89, Safari 16.4 and later have it.';
    if (typeof Worker !== 'function') return 'This browser has no workers, in which Drypoint draws.';
    if (!HTMLCanvasElement.prototype.transferControlToOffscreen || typeof OffscreenCanvas !== 'function')
        return 'This browser cannot draw beside the page (OffscreenCanvas): Chrome 69, Firefox 105, Safari 16.4 and later can.';
    return null;
}

/** Says in the place of the drawing why there is none. */
export function show_fatal(text) {
    const waiting = document.getElementById('waiting');
    waiting.className = 'fatal';
    waiting.setAttribute('role', 'alert');
    waiting.replaceChildren(Object.assign(document.createElement('p'), { textContent: text }));
    waiting.hidden = false;
}

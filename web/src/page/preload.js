/* Asks for the WebAssembly while the worker that wants it is still being read: else one would follow the other. What
 * comes is thrown away here, and lies in the browser's cache. Where a service worker answers there is nothing to wait
 * for. (A <link rel=preload> serves documents alone, not workers.) */

export function preload_engine() {
    if (navigator.serviceWorker?.controller) return;
    const threads = self.crossOriginIsolated && navigator.hardwareConcurrency > 1; // as the engine chooses
    fetch(threads ? 'drypoint-threads.wasm' : 'drypoint.wasm')
        .then((answer) => answer.arrayBuffer())
        .catch(() => {}); // the worker will say what is wrong
}

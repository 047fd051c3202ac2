/* Asks for what the worker will want while that is still being read: else one would follow the other. Where a service
 * worker answers there is nothing to wait for. */

export function preload_engine() {
    if (navigator.serviceWorker?.controller) return;
    const threads = self.crossOriginIsolated && navigator.hardwareConcurrency > 1; // as the engine chooses
    const link = document.createElement('link');
    Object.assign(link, { rel: 'preload', as: 'fetch', crossOrigin: 'anonymous' });
    link.href = threads ? 'drypoint-threads.wasm' : 'drypoint.wasm';
    document.head.append(link);
}

/* Keeps the page for visits without a network, where there are service workers: not in files, and only on servers that
 * are safe (https, or this computer). Whoever opens the page meanwhile sees the version that was there. */

/** `ready`: all files are kept. `newer`: another version is kept and waits for the next visit. */
export async function register_offline(ready, newer) {
    if (!('serviceWorker' in navigator) || !window.isSecureContext || !location.protocol.startsWith('http')) return;
    const controlled = Boolean(navigator.serviceWorker.controller);
    try {
        const registration = await navigator.serviceWorker.register('sw.js', { updateViaCache: 'none' });
        registration.addEventListener('updatefound', () => {
            const fresh = registration.installing;
            fresh?.addEventListener('statechange', () => {
                if (fresh.state === 'installed' && controlled) newer();
            });
        });
        await navigator.serviceWorker.ready;
        ready();
    } catch {
        /* forbidden or without room: the page works as long as there is a network */
    }
}

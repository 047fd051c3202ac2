/* Keeps the page for visits without a network, where there are service workers: not in files, and only on servers that
 * are safe (https, or this computer). Whoever opens the page meanwhile sees the version that was there. */

/* The page is loaded again once the new version is the one that answers. */
function change_over(fresh) {
    navigator.serviceWorker.addEventListener('controllerchange', () => location.reload(), { once: true });
    fresh.postMessage('take over');
}

/** `ready`: all files are kept. `newer(change)`: another version is kept, and waits for change(), or until no page is
 * open that uses the one before. */
export async function register_offline(ready, newer) {
    if (!('serviceWorker' in navigator) || !window.isSecureContext || !location.protocol.startsWith('http')) return;
    const controlled = Boolean(navigator.serviceWorker.controller);
    try {
        const registration = await navigator.serviceWorker.register('sw.js', { updateViaCache: 'none' });
        const tell_newer = (fresh) => controlled && newer(() => change_over(fresh));
        if (registration.waiting) tell_newer(registration.waiting);
        registration.addEventListener('updatefound', () => {
            const fresh = registration.installing;
            fresh?.addEventListener('statechange', () => fresh.state === 'installed' && tell_newer(fresh));
        });
        await navigator.serviceWorker.ready;
        ready();
    } catch {
        /* forbidden or without room: the page works as long as there is a network */
    }
}

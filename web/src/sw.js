/* Keeps the page in the browser: all files of one version, in one cache, so that no visit mixes two.
 *
 * The build defines PRECACHE, [[name, hash], ...], and VERSION. Files that the version before has with the same hash
 * are taken from its cache. A new version waits until no page is open that uses the old one, or until a page asks for it. Answers carry the headers
 * that let threads share memory, so that hosts whose headers cannot be set draw with all cores from the second visit on. */
/* global PRECACHE, VERSION */

const prefix = 'drypoint-';
const cache_name = prefix + VERSION;
const hash_header = 'X-Drypoint-Hash';
const isolation = {
    'Cross-Origin-Opener-Policy': 'same-origin',
    'Cross-Origin-Embedder-Policy': 'require-corp',
    'Cross-Origin-Resource-Policy': 'same-origin',
};

const address_of = (name) => new URL(name, self.registration.scope).href;

/* The answer with headers of our own. */
function sealed(response, hash) {
    const headers = new Headers(response.headers);
    for (const [name, value] of Object.entries(isolation)) headers.set(name, value);
    headers.set(hash_header, hash);
    headers.delete('Content-Encoding'); // the body is decoded
    headers.delete('Content-Length');
    return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}

async function take(cache, name, hash) {
    const address = address_of(name);
    const old = await caches.match(address);
    if (old?.headers.get(hash_header) === hash) return cache.put(address, old);
    const fresh = await fetch(address, { cache: 'no-cache' });
    if (!fresh.ok || fresh.redirected) throw new Error(`${name}: ${fresh.status}`);
    return cache.put(address, sealed(fresh, hash));
}

async function install() {
    const cache = await caches.open(cache_name);
    await Promise.all(PRECACHE.map(([name, hash]) => take(cache, name, hash)));
}

async function activate() {
    for (const name of await caches.keys()) if (name.startsWith(prefix) && name !== cache_name) await caches.delete(name);
    await self.clients.claim();
}

async function answer(request) {
    const address = new URL(request.url);
    address.search = '';
    address.hash = '';
    if (address.href === self.registration.scope) address.href = address_of('index.html');
    const kept = await (await caches.open(cache_name)).match(address.href);
    return kept ?? fetch(request);
}

self.addEventListener('install', (event) => event.waitUntil(install()));
self.addEventListener('activate', (event) => event.waitUntil(activate()));
self.addEventListener('message', (event) => event.data === 'take over' && self.skipWaiting());
self.addEventListener('fetch', (event) => {
    const { method, url } = event.request;
    if (method === 'GET' && url.startsWith(self.registration.scope)) event.respondWith(answer(event.request));
});

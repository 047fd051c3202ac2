#!/usr/bin/env node
/* serve.mjs [FOLDER] [--port N] [--host NAME] [--no-isolation]: shows a folder, build/web if none is named, to a browser.
 *
 * It sends the headers that let a page share memory between threads (COOP, COEP, CORP); --no-isolation leaves them out,
 * as hosts do whose headers cannot be set. A browser asks each time whether a file has changed, so that what was built
 * last is what it shows. Port 0: any free one. It shows files of that folder alone, by GET and HEAD, and no listings. */
import { createServer } from 'node:http';
import { createReadStream } from 'node:fs';
import { realpath, stat } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const types = {
    '.html': 'text/html; charset=utf-8',
    '.css': 'text/css; charset=utf-8',
    '.js': 'text/javascript; charset=utf-8',
    '.mjs': 'text/javascript; charset=utf-8',
    '.json': 'application/json',
    '.map': 'application/json',
    '.webmanifest': 'application/manifest+json',
    '.wasm': 'application/wasm',
    '.svg': 'image/svg+xml',
    '.png': 'image/png',
    '.webp': 'image/webp',
    '.ico': 'image/x-icon',
    '.txt': 'text/plain; charset=utf-8',
};

const isolation = {
    'Cross-Origin-Opener-Policy': 'same-origin',
    'Cross-Origin-Embedder-Policy': 'require-corp',
    'Cross-Origin-Resource-Policy': 'same-origin',
};

/* The file that an address names, or null: there is none inside the folder. */
async function find(root, address) {
    let name;
    try {
        name = decodeURIComponent(new URL(address, 'http://localhost').pathname);
    } catch {
        return null; // no address
    }
    if (name.includes('\0')) return null;
    try {
        let file = await realpath(path.join(root, name)); // a link may lead elsewhere
        if (file !== root && !file.startsWith(root + path.sep)) return null;
        let about = await stat(file);
        if (about.isDirectory()) {
            if (!name.endsWith('/')) return null;
            file = path.join(file, 'index.html');
            about = await stat(file);
        }
        return about.isFile() ? { file, about } : null;
    } catch {
        return null;
    }
}

async function answer(root, headers, request, response) {
    if (request.method !== 'GET' && request.method !== 'HEAD') {
        response.writeHead(405, { ...headers, Allow: 'GET, HEAD' }).end();
        return;
    }
    const found = await find(root, request.url);
    if (!found) {
        response.writeHead(404, { ...headers, 'Content-Type': types['.txt'] });
        response.end(request.method === 'HEAD' ? undefined : 'There is no such file.\n');
        return;
    }
    const tag = `"${found.about.size.toString(36)}-${Math.round(found.about.mtimeMs).toString(36)}"`;
    const all = { ...headers, ETag: tag, 'Cache-Control': 'no-cache', 'X-Content-Type-Options': 'nosniff' };
    if (request.headers['if-none-match'] === tag) {
        response.writeHead(304, all).end();
        return;
    }
    all['Content-Type'] = types[path.extname(found.file).toLowerCase()] ?? 'application/octet-stream';
    all['Content-Length'] = found.about.size;
    response.writeHead(200, all);
    if (request.method === 'HEAD') {
        response.end();
        return;
    }
    createReadStream(found.file)
        .on('error', () => response.destroy())
        .pipe(response);
}

/* Starts a server: {address, port, close()}. */
export async function serve({ root, port = 0, host = 'localhost', isolated = true }) {
    const folder = await realpath(root);
    const headers = isolated ? isolation : {};
    const server = createServer((request, response) => answer(folder, headers, request, response));
    await new Promise((resolve, reject) => server.once('error', reject).listen(port, host, resolve));
    const bound = server.address().port;
    return {
        address: `http://${host.includes(':') ? `[${host}]` : host}:${bound}/`,
        port: bound,
        close() {
            server.closeAllConnections();
            return new Promise((resolve) => server.close(resolve));
        },
    };
}

function complain(text) {
    console.error(`serve: ${text}`);
    process.exit(1);
}

function read_arguments() {
    try {
        const { values, positionals } = parseArgs({
            allowPositionals: true,
            options: {
                port: { type: 'string', default: '8000' },
                host: { type: 'string', default: 'localhost' },
                'no-isolation': { type: 'boolean', default: false },
            },
        });
        if (positionals.length > 1) throw new Error('one folder, please');
        if (!/^\d+$/.test(values.port) || Number(values.port) > 65535) throw new Error(`no port: ${values.port}`);
        const root = positionals[0] ?? fileURLToPath(new URL('../build/web', import.meta.url));
        return { root, port: Number(values.port), host: values.host, isolated: !values['no-isolation'] };
    } catch (error) {
        return complain(`${error.message}\nserve.mjs [FOLDER] [--port N] [--host NAME] [--no-isolation]`);
    }
}

async function main() {
    const settings = read_arguments();
    try {
        await stat(path.join(settings.root, 'index.html'));
    } catch {
        complain(`${settings.root} holds no page; \`make web\` builds it`);
    }
    try {
        const { address } = await serve(settings);
        console.log(`serve: ${address}  (Ctrl-C ends it)`);
    } catch (error) {
        complain(error.code === 'EADDRINUSE' ? `port ${settings.port} is taken; --port 0 takes a free one` : error.message);
    }
}

if (process.argv[1] && (await realpath(process.argv[1])) === fileURLToPath(import.meta.url)) await main();

#!/usr/bin/env node
/* server.mjs: tests of serve.mjs, without a browser; prints TAP. */
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { serve } from '../serve.mjs';

const base = mkdtempSync(path.join(tmpdir(), 'drypoint-serve-'));
const root = path.join(base, 'root');
mkdirSync(path.join(root, 'icons'), { recursive: true });
writeFileSync(path.join(root, 'index.html'), '<p>page</p>');
writeFileSync(path.join(root, 'a b.mjs'), 'export {};');
writeFileSync(path.join(root, 'x.wasm'), Buffer.from([0, 97, 115, 109]));
writeFileSync(path.join(base, 'secret.txt'), 'secret');
mkdirSync(path.join(base, 'root-2'));
writeFileSync(path.join(base, 'root-2/secret.txt'), 'secret');
symlinkSync(path.join(base, 'secret.txt'), path.join(root, 'link.txt'));

/* Paths go as they are: fetch() would tidy them up. */
function ask(server, where, { method = 'GET', headers = {} } = {}) {
    return new Promise((resolve, reject) => {
        request({ host: 'localhost', port: server.port, path: where, method, headers }, (response) => {
            const parts = [];
            response.on('data', (part) => parts.push(part));
            response.on('end', () => resolve({ status: response.statusCode, headers: response.headers, text: Buffer.concat(parts).toString() }));
        }).on('error', reject).end();
    });
}

const tests = {
    'the page, with the headers that threads need': async (server) => {
        const { status, headers, text } = await ask(server, '/');
        assert.deepEqual([status, text], [200, '<p>page</p>']);
        assert.equal(headers['cross-origin-opener-policy'], 'same-origin');
        assert.equal(headers['cross-origin-embedder-policy'], 'require-corp');
        assert.equal(headers['cross-origin-resource-policy'], 'same-origin');
    },
    'types that browsers insist on': async (server) => {
        assert.match((await ask(server, '/a%20b.mjs')).headers['content-type'], /^text\/javascript/);
        assert.equal((await ask(server, '/x.wasm?version=2')).headers['content-type'], 'application/wasm');
    },
    'a file that has not changed is not sent again': async (server) => {
        const { headers } = await ask(server, '/x.wasm');
        assert.equal(headers['cache-control'], 'no-cache');
        const again = await ask(server, '/x.wasm', { headers: { 'If-None-Match': headers.etag } });
        assert.deepEqual([again.status, again.text], [304, '']);
        writeFileSync(path.join(root, 'x.wasm'), Buffer.from([0, 97, 115, 109, 1]));
        assert.equal((await ask(server, '/x.wasm', { headers: { 'If-None-Match': headers.etag } })).status, 200);
    },
    'nothing outside the folder': async (server) => {
        for (const where of ['/../secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt', '/icons/../../secret.txt', '/../root-2/secret.txt',
            '/..%2froot-2/secret.txt', '/link.txt', '//etc/passwd', '/%00', '/%', '/icons', '/icons/', '/none', '/..%5csecret.txt']) {
            const { status, text } = await ask(server, where);
            assert.equal(status, 404, where);
            assert.ok(!text.includes('secret'), where);
        }
    },
    'GET and HEAD alone': async (server) => {
        assert.equal((await ask(server, '/', { method: 'POST' })).status, 405);
        const head = await ask(server, '/', { method: 'HEAD' });
        assert.deepEqual([head.status, head.text, head.headers['content-length']], [200, '', '11']);
    },
    'without isolation on request': async () => {
        const other = await serve({ root, isolated: false });
        const { headers } = await ask(other, '/');
        assert.equal(headers['cross-origin-opener-policy'], undefined);
        assert.equal(headers['cross-origin-embedder-policy'], undefined);
        await other.close();
    },
};

const server = await serve({ root });
let number = 0;
let failed = 0;
for (const [name, run] of Object.entries(tests)) {
    number++;
    try {
        await run(server);
        console.log(`ok ${number} - ${name}`);
    } catch (error) {
        failed++;
        console.log(`not ok ${number} - ${name}\n${String(error.stack).replace(/^/gm, '# ')}`);
    }
}
console.log(`1..${number}`);
await server.close();
rmSync(base, { recursive: true });
process.exit(failed ? 1 : 0);

#!/usr/bin/env node
/* build.mjs [--single FOLDER] [--threads FOLDER] [--out FOLDER] [--debug]: puts the page together in build/web.
 *
 * It bundles and minifies the scripts with esbuild (npm's, if web/node_modules holds it, else the one on the PATH, as
 * Debian's package puts it there), copies page, style, icons and both WebAssembly builds, and tells the service worker
 * which files there are and by which hash of their content. At the end it lists the sizes, as brotli makes them, and
 * fails, with the page in its place, if a visit takes more than `most` without optional parts: those that are loaded when a
 * script asks for them (import()), the WebAssembly build that the visitor's browser does not choose, and pictures. */
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cp, mkdir, readdir, readFile, rename, rm, stat, writeFile } from 'node:fs/promises';
import { existsSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { brotliCompressSync, constants } from 'node:zlib';

const most = 350 * 1024; /* bytes by brotli */

const web = path.dirname(fileURLToPath(import.meta.url));
const { values: option } = parseArgs({
    options: {
        single: { type: 'string', default: path.join(web, '../build/web-single') },
        threads: { type: 'string', default: path.join(web, '../build/web-threads') },
        out: { type: 'string', default: path.join(web, '../build/web') },
        debug: { type: 'boolean', default: false }, // readable scripts, with source maps
    },
});
const out = path.resolve(option.out);
const work = `${out}.new`; // becomes `out` once all is there

function fail(text) {
    console.error(`build: ${text}`);
    process.exit(1);
}

function find_esbuild() {
    const local = path.join(web, 'node_modules/.bin/esbuild');
    return existsSync(local) ? local : 'esbuild';
}

function esbuild(...words) {
    try {
        execFileSync(find_esbuild(), ['--log-level=warning', ...words], { cwd: web, stdio: ['ignore', 'inherit', 'inherit'] });
    } catch (error) {
        if (error.code === 'ENOENT') fail('esbuild is missing: `scripts/setup.sh web`, or `npm install --no-save esbuild` in web/');
        fail('esbuild found faults');
    }
}

const size_words = option.debug ? ['--sourcemap'] : ['--minify'];

/* Packages that a part may go without: if they are not installed, its import() fails, and the part says what it does
 * then. */
const optional_packages = ['meshoptimizer'];
function package_words() {
    const missing = optional_packages.filter((name) => !existsSync(path.join(web, 'node_modules', name)));
    for (const name of missing) console.error(`build: without ${name}, which \`npm ci\` in web/ installs`);
    return missing.map((name) => `--external:${name}`);
}

/* Bundles the script whose name in the page is `name`, and tells which files of it are loaded later, by import(). */
async function bundle(name, source) {
    const meta = path.join(work, `${name}.meta.json`);
    esbuild(
        `${name}=${source}`, '--bundle', '--splitting', '--format=esm', '--target=es2022', '--chunk-names=part-[name]-[hash]',
        `--outdir=${work}`, `--metafile=${meta}`, ...size_words, ...package_words(),
    );
    const { outputs } = JSON.parse(await readFile(meta, 'utf8'));
    await rm(meta);
    const file_of = (key) => path.relative(work, path.resolve(web, key));
    const once = new Set();
    const visit = (key) => {
        if (!outputs[key] || once.has(key)) return;
        once.add(key);
        for (const used of outputs[key].imports) if (used.kind === 'import-statement') visit(used.path);
    };
    visit(Object.keys(outputs).find((key) => file_of(key) === `${name}.js`));
    return Object.keys(outputs).filter((key) => !once.has(key)).map(file_of);
}

async function copy_page() {
    for (const name of await readdir(web)) {
        if (/\.(html|webmanifest|svg|png|ico|txt)$/.test(name)) await cp(path.join(web, name), path.join(work, name));
    }
    if (existsSync(path.join(web, 'icons'))) await cp(path.join(web, 'icons'), path.join(work, 'icons'), { recursive: true });
    if (existsSync(path.join(web, 'style.css'))) esbuild('style.css', '--bundle', `--outfile=${path.join(work, 'style.css')}`, '--external:*.svg', ...size_words);
}

/* The files of a WebAssembly build: the module, its script and its threads' script. */
async function copy_wasm(folder, stem) {
    const place = [folder, path.join(folder, 'web'), path.join(folder, 'web/c')].find((at) => existsSync(path.join(at, `${stem}.mjs`)));
    if (!place) fail(`${folder} holds no ${stem}.mjs; \`make web\` builds it`);
    const names = (await readdir(place)).filter((name) => name.startsWith(`${stem}.`) && /\.(mjs|js|wasm)$/.test(name));
    for (const name of names) {
        if (name.endsWith('.mjs')) esbuild(path.join(place, name), '--format=esm', `--outfile=${path.join(work, name)}`, ...size_words);
        else await cp(path.join(place, name), path.join(work, name));
    }
    return names;
}

/* All files below a folder, by name. */
async function list(folder, below = '') {
    const names = [];
    for (const entry of await readdir(path.join(folder, below), { withFileTypes: true })) {
        const name = path.posix.join(below, entry.name);
        if (entry.isDirectory()) names.push(...(await list(folder, name)));
        else names.push(name);
    }
    return names.sort();
}

const hash = (bytes) => createHash('sha256').update(bytes).digest('hex').slice(0, 16);

/* The service worker, which finds PRECACHE, [[name, hash], ...], and VERSION, the hash of it all, defined. */
async function write_service_worker() {
    const source = 'src/sw.js';
    if (!existsSync(path.join(web, source))) return;
    const files = [];
    for (const name of await list(work)) {
        if (!name.endsWith('.map')) files.push([name, hash(await readFile(path.join(work, name)))]);
    }
    const text = JSON.stringify(files);
    esbuild(
        source, '--bundle', '--target=es2022', `--outfile=${path.join(work, 'sw.js')}`, `--define:PRECACHE=${text}`,
        `--define:VERSION=${JSON.stringify(hash(text))}`, ...size_words,
    );
}

const brotli = (bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length;

/* Lists the sizes; `later` are the scripts that import() loads; of the WebAssembly builds a visit takes one. */
async function report(later, builds) {
    const parts = [];
    const size = {};
    for (const name of await list(work)) {
        if (name.endsWith('.map')) continue;
        const bytes = await readFile(path.join(work, name));
        size[name] = brotli(bytes);
        const needed = !later.has(name) && !/\.(png|webp|svg)$/.test(name);
        if (needed && !builds.some((names) => names.includes(name))) parts.push(name);
        console.log(`${name.padEnd(32)} ${String(bytes.length).padStart(8)} ${String(size[name]).padStart(8)}${needed ? '' : '  optional'}`);
    }
    const sum = (names) => names.reduce((total, name) => total + (size[name] ?? 0), 0);
    const visit = sum(parts) + Math.max(...builds.map(sum));
    console.log(`build: a visit takes ${(visit / 1024).toFixed(1)} KiB by brotli, of at most ${most / 1024}; all files ${(sum(Object.keys(size)) / 1024).toFixed(1)} KiB`);
    return visit;
}

await rm(work, { recursive: true, force: true });
await mkdir(work, { recursive: true });
const later = new Set();
for (const [name, source] of [['page', 'src/page/main.js'], ['worker', 'src/engine/worker.js']]) {
    if (!existsSync(path.join(web, source))) fail(`there is no web/${source}`);
    for (const file of await bundle(name, source)) later.add(file);
}
await copy_page();
const builds = [await copy_wasm(option.single, 'drypoint'), await copy_wasm(option.threads, 'drypoint-threads')];
await write_service_worker();
const visit = await report(later, builds);
await rm(out, { recursive: true, force: true });
await rename(work, out);
console.log(`build: ${path.relative(process.cwd(), out) || '.'} is ready; \`make serve\` shows it`);
if (visit > most && !option.debug) fail('a visit takes too much');

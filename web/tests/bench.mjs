/* What the page's tests share: a server, a browser, visits to the page, and the native program to compare with. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { serve } from '../serve.mjs';
import { read_png } from './png.mjs';

const project = fileURLToPath(new URL('../../', import.meta.url));

/* Where the tests find things; run.mjs changes them by its options. */
export const place = {
    page: path.join(project, 'build/web'),
    program: ['build/check-gcc/drypoint', 'build/drypoint'].map((name) => path.join(project, name)).find((name) => existsSync(name)),
    chromium: process.env.CHROMIUM || ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((name) => existsSync(name)),
    folder: mkdtempSync(path.join(tmpdir(), 'drypoint-web-')), // for files; goes at the end
};
process.on('exit', () => rmSync(place.folder, { recursive: true, force: true }));

export const patience = 60_000; /* ms; CI is slow at times */

// ---- tests ----

export const tests = [];

/* Registers a test: `run` gets a Bench and says by an exception what is wrong; a text it returns is printed. */
export function test(name, run, { isolated = true, slow = false } = {}) {
    tests.push({ name, run, isolated, slow });
}

// ---- the native program ----

export function sha256(bytes) {
    return createHash('sha256').update(bytes).digest('hex');
}

/* Runs a command line as the page shows it, which begins with `drypoint`, where the test's files are. */
export function run_program(command) {
    assert.match(command, /^drypoint /);
    try {
        execFileSync('sh', ['-c', `"$DRYPOINT" ${command.slice('drypoint '.length)}`], {
            cwd: place.folder, env: { ...process.env, DRYPOINT: place.program }, stdio: ['ignore', 'pipe', 'pipe'],
        });
    } catch (error) {
        throw new Error(`${command}: ${error.stderr || error.message}`);
    }
}

/* What the program's command line writes to its `-o FILE`, under another ending if one is given. */
export function output_of(command, ending = '.png') {
    const words = /^(.* -o )('?)([^']+?)\.[a-z]+\2$/.exec(command);
    assert.ok(words, `no -o at the end: ${command}`);
    run_program(`${words[1]}'out${ending}'`);
    return readFileSync(path.join(place.folder, `out${ending}`));
}

export function make_model(words, name) {
    const file = path.join(place.folder, name);
    if (!existsSync(file)) run_program(`drypoint make ${words} -q -o '${name}'`);
    return file;
}

// ---- visits ----

/* A visit to the page by a browser of its own storage; it notes what must not happen. */
export class Visit {
    constructor(context, page, address) {
        this.context = context;
        this.page = page;
        this.origin = new URL(address).origin;
        this.faults = []; // console errors, exceptions, requests elsewhere
        this.expected = []; // patterns of faults that the test wants
        context.on('request', (request) => {
            const url = new URL(request.url());
            if (!['blob:', 'data:'].includes(url.protocol) && url.origin !== this.origin) this.faults.push(`a request leaves the page: ${url}`);
        });
        this.watch(page);
    }

    watch(page) {
        page.on('console', (message) => {
            if (message.type() === 'error') this.faults.push(`console: ${message.text()}`);
        });
        page.on('pageerror', (error) => this.faults.push(`exception: ${error.stack ?? error}`));
        page.on('crash', () => this.faults.push('the page crashed'));
    }

    check() {
        const faults = this.faults.filter((text) => !this.expected.some((pattern) => pattern.test(text)));
        assert.deepEqual(faults, []);
    }

    /* Until the picture on the canvas is the full one of the present state. */
    async ready(page = this.page) {
        await page.waitForFunction(() => document.documentElement.dataset.state === 'ready', null, { timeout: patience, polling: 20 });
    }

    /* Does something that changes the picture, and waits for the new one. */
    async change(action) {
        const before = (await this.picture()).serial;
        await action();
        await this.page.waitForFunction((last) => window.drawn_pictures > last, before, { timeout: patience, polling: 20 })
            .catch(() => assert.fail(`no new picture after ${action}`));
        await this.ready();
    }

    /* The picture that is shown: {width, height, hash, serial}; hash: of its RGBA pixels. */
    picture(page = this.page) {
        return page.evaluate(async () => {
            const { width, height, data } = await window.drypoint.engine.pixels();
            const digest = await crypto.subtle.digest('SHA-256', new Uint8Array(data)); // a copy: it may be shared
            const hash = Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, '0')).join('');
            return { width, height, hash, serial: window.drawn_pictures };
        });
    }

    async command() {
        return (await this.page.locator('#command').textContent()).trim();
    }

    /* Is the picture, pixel for pixel, what the native program draws by the command line shown? */
    async same_as_program() {
        const [picture, command] = [await this.picture(), await this.command()];
        const native = read_png(output_of(command));
        assert.deepEqual([picture.width, picture.height], [native.width, native.height], command);
        assert.equal(picture.hash, sha256(native.data), `not the program's picture: ${command}`);
        return picture;
    }

    /* Drops files on the window: {name, data: Buffer | string} or paths. */
    async drop(files) {
        const items = files.map((file) => (typeof file === 'string' ? { name: path.basename(file), data: readFileSync(file) } : file));
        const sent = items.map(({ name, data }) => ({ name, text: Buffer.from(data).toString('base64') }));
        const transfer = await this.page.evaluateHandle(async (list) => {
            const transfer = new DataTransfer();
            for (const { name, text } of list) {
                const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
                transfer.items.add(new File([bytes], name));
            }
            return transfer;
        }, sent);
        for (const type of ['dragenter', 'dragover', 'drop']) await this.page.dispatchEvent('body', type, { dataTransfer: transfer });
        await transfer.dispose();
    }

    /* The name of the model that is shown. */
    model() {
        return this.page.evaluate(() => window.model_shown);
    }

    /* Waits for a message that is shown, whose text matches. */
    async message(pattern) {
        const found = await this.page.waitForFunction(
            ([source, flags]) => {
                const text = document.querySelector('#messages').textContent;
                return new RegExp(source, flags).test(text) ? text : null;
            },
            [pattern.source, pattern.flags],
            { timeout: patience, polling: 20 },
        ).catch(async () => assert.fail(`no message like ${pattern}, but: ${await this.page.locator('#messages').textContent()}`));
        return found.jsonValue();
    }

    /* Clicks and gives the bytes that are downloaded: {name, bytes}. */
    async download(selector) {
        const [download] = await Promise.all([this.page.waitForEvent('download', { timeout: patience }), this.page.click(selector)]);
        return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
    }

    async press(...keys) {
        for (const key of keys) await this.page.keyboard.press(key);
    }
}

/* In the page, before its own scripts: counts full pictures and notes the model. */
function listen() {
    window.drawn_pictures = 0;
    window.model_shown = null;
    window.progress_seen = [];
    window.frames_seen = [];
    let engine;
    const attach = () => {
        engine.addEventListener('frame', ({ detail }) => {
            if (detail.full) window.drawn_pictures++;
            window.frames_seen.push({ ...detail, at: performance.now() });
        });
        engine.addEventListener('state', ({ detail }) => (window.model_shown = detail.model?.name ?? null));
        engine.addEventListener('progress', ({ detail }) => window.progress_seen.push(detail));
    };
    let kept;
    Object.defineProperty(window, 'drypoint', {
        get: () => kept,
        set(value) {
            kept = value;
            if (value?.engine && value.engine !== engine) {
                engine = value.engine;
                attach();
            }
        },
        configurable: true,
    });
}

export class Bench {
    constructor(browser, server) {
        this.browser = browser;
        this.server = server;
        this.address = server.address;
        this.visits = [];
    }

    /* Opens the page in a browser of its own storage, and waits for its first picture. */
    async visit({ path: where = '', address = this.address, wait = true, ...options } = {}) {
        const context = await this.browser.newContext({ viewport: { width: 1000, height: 700 }, acceptDownloads: true, ...options });
        context.setDefaultTimeout(patience);
        await context.addInitScript(listen);
        const page = await context.newPage();
        const visit = new Visit(context, page, address);
        this.visits.push(visit);
        await page.goto(address + where);
        if (wait) await visit.ready();
        return visit;
    }

    async end() {
        for (const visit of this.visits) await visit.context.close();
    }
}

export async function start_server(isolated, port = 0) {
    return serve({ root: place.page, isolated, port });
}

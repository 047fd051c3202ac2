#!/usr/bin/env node
/* run.mjs [--page FOLDER] [--program FILE] [--no-slow] [--no-isolation] [--list] [PATTERN...]: tests the page in Chromium, and
 * prints TAP. --no-isolation: all of them with the build of one thread, but those that need the other.
 *
 * PATTERN: only tests whose names hold one of these. Exit status 77: there is no browser, or no package to drive it. */
import { readdir } from 'node:fs/promises';
import { parseArgs } from 'node:util';
import { Bench, place, start_server, tests } from './bench.mjs';

const { values: option, positionals: patterns } = parseArgs({
    allowPositionals: true,
    options: {
        page: { type: 'string' },
        program: { type: 'string' },
        'no-slow': { type: 'boolean', default: false },
        'no-isolation': { type: 'boolean', default: false },
        list: { type: 'boolean', default: false },
    },
});
if (option.page) place.page = option.page;
if (option.program) place.program = option.program;

const too_long = 180_000; /* ms a test */

function skip(why) {
    console.log(`1..0 # SKIP ${why}`);
    process.exit(77);
}

async function start_browser() {
    if (!place.chromium) skip('no Chromium; `scripts/setup.sh check` installs it, or CHROMIUM names it');
    try {
        const { chromium } = await import('playwright-core');
        return await chromium.launch({ executablePath: place.chromium, args: ['--no-sandbox', '--disable-dev-shm-usage'] });
    } catch (error) {
        if (error.code === 'ERR_MODULE_NOT_FOUND') skip('no playwright-core; `npm ci` in web/ installs it');
        throw error;
    }
}

function in_time(promise, name) {
    let timer;
    const late = new Promise((resolve, reject) => {
        timer = setTimeout(() => reject(new Error(`${name}: no end after ${too_long / 1000} s`)), too_long);
    });
    return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

async function run_one(browser, { name, run, isolated }) {
    const server = await start_server(isolated && !option['no-isolation']);
    const bench = new Bench(browser, server);
    try {
        const note = await in_time(run(bench), name);
        for (const visit of bench.visits) visit.check();
        return { note };
    } catch (error) {
        return { error, faults: bench.visits.flatMap((visit) => visit.faults) };
    } finally {
        await in_time(bench.end(), 'closing').catch((error) => console.log(`# ${error.message.split('\n')[0]}`));
        await server.close();
    }
}

for (const file of (await readdir(import.meta.dirname ?? new URL('.', import.meta.url))).sort()) {
    if (file.endsWith('.test.mjs')) await import(`./${file}`);
}
const chosen = tests.filter(({ name, slow }) => (!patterns.length || patterns.some((p) => name.includes(p))) && !(slow && option['no-slow']) && !(/on threads/.test(name) && option['no-isolation']));
if (option.list) {
    for (const { name } of chosen) console.log(name);
    process.exit(0);
}
if (!chosen.length) {
    console.error('run: no test has such a name');
    process.exit(2);
}
let browser = await start_browser();
let number = 0;
let failed = 0;
for (const one of chosen) {
    const start = performance.now();
    if (!browser.isConnected()) browser = await start_browser(); // it crashed: the test before has failed
    const { error, note, faults } = await run_one(browser, one);
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    number++;
    if (error) failed++;
    console.log(`${error ? 'not ok' : 'ok'} ${number} - ${one.name} # ${seconds} s${note ? `, ${note}` : ''}`);
    if (error) console.log(`${error.stack ?? error}${faults.length ? `\nthe page: ${faults.join('\n')}` : ''}`.replace(/^/gm, '# '));
}
console.log(`1..${number}`);
await browser.close().catch(() => 0);
process.exit(failed ? 1 : 0);

#!/usr/bin/env node
/* figures.mjs [MODEL...]: how fast the page is in Chromium here, as a table in Markdown; with models, also when these move.
 *
 * First picture: the page's mark of that name, on a second visit, whose files the browser has. Frames: while the pointer
 * drags for three seconds without a pause, drawn frames a second, and what one takes in the worker; a model of above
 * 150 000 triangles moves as its simplified draft once that is ready, which is waited for. The rest of the machine should
 * be quiet; its load is printed. */
import { loadavg, cpus } from 'node:os';
import path from 'node:path';
import { Bench, make_model, place, start_server } from './bench.mjs';
import { chromium } from 'playwright-core';

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

async function first_pictures(bench, times = 5) {
    const visit = await bench.visit();
    await visit.page.evaluate(() => navigator.serviceWorker?.ready.then(() => 0));
    const found = [];
    for (let i = 0; i < times; i++) {
        await visit.page.goto('about:blank');
        await visit.page.goto(bench.address);
        await visit.ready();
        found.push(await visit.page.evaluate(() => performance.getEntriesByName('first-picture')[0].startTime));
    }
    return found;
}

/* Drags round in circles for so long; the frames that were drawn meanwhile. */
async function orbit(visit, ms) {
    const box = await visit.page.locator('#picture').boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await visit.page.mouse.move(x, y);
    await visit.page.mouse.down();
    await visit.page.evaluate(() => (window.frames_seen = []));
    const start = performance.now();
    for (let i = 0; performance.now() - start < ms; i++) {
        await visit.page.mouse.move(x + 150 * Math.sin(i / 20), y + 100 * Math.cos(i / 20));
    }
    const frames = await visit.page.evaluate(() => window.frames_seen);
    await visit.page.mouse.up();
    await visit.ready();
    return frames;
}

async function measure(bench, file) {
    const visit = await bench.visit({ viewport: { width: 1280, height: 800 } });
    const start = performance.now();
    await visit.change(() => visit.page.setInputFiles('#file', file));
    const opened = performance.now() - start;
    await visit.page.waitForTimeout(500);
    await orbit(visit, 1000);
    for (let i = 0; i < 20 && (await orbit(visit, 300)).some(({ simplified }) => simplified === false); i++) await visit.page.waitForTimeout(500);
    const frames = await orbit(visit, 3000);
    const span = (frames.at(-1).at - frames[0].at) / 1000;
    const { width, height } = await visit.picture();
    const full = await visit.page.evaluate(() => window.frames_seen.findLast(({ full: whole }) => whole)?.ms);
    await visit.context.close();
    return { opened, rate: (frames.length - 1) / span, ms: median(frames.map(({ ms }) => ms)), full, width, height };
}

const browser = await chromium.launch({ executablePath: place.chromium, args: ['--no-sandbox', '--disable-dev-shm-usage'] });
const server = await start_server(true);
const bench = new Bench(browser, server);
console.log(`${cpus().length} processors (${cpus()[0].model.trim()}), load ${loadavg()[0].toFixed(1)}, Chromium ${browser.version()}\n`);
const first = await first_pictures(bench);
console.log(`first picture, warm: ${Math.round(median(first))} ms (${first.map(Math.round).join(', ')})\n`);
const files = [make_model('terrain --triangles 60000', 'terrain-60k.ply'), ...process.argv.slice(2).map((name) => path.resolve(name))];
console.log('| model | picture | opened and drawn, ms | frames a second while it is dragged | a frame, ms | full picture, ms |');
console.log('|---|---|---|---|---|---|');
for (const file of files) {
    const { opened, rate, ms, full, width, height } = await measure(bench, file);
    console.log(`| ${path.basename(file)} | ${width}×${height} | ${Math.round(opened)} | ${rate.toFixed(1)} | ${ms.toFixed(1)} | ${full?.toFixed(0) ?? '–'} |`);
}
await browser.close();
await server.close();
process.exit(0);

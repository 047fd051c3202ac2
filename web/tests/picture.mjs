#!/usr/bin/env node
/* picture.mjs OUT.png [--page FOLDER]: takes the picture of the page that docs/web.md shows. Needs what the tests need,
 * and ImageMagick, which makes it small. */
import { execFileSync } from 'node:child_process';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { chromium } from 'playwright-core';
import { serve } from '../serve.mjs';

const { values: option, positionals } = parseArgs({ allowPositionals: true, options: { page: { type: 'string' } } });
if (positionals.length !== 1) {
    console.error('usage: picture.mjs OUT.png [--page FOLDER]');
    process.exit(2);
}

const what = new URLSearchParams({
    shape: 'gear',
    with: '--preset illustration --azimuth 38 --elevation 24',
});
const root = option.page ?? path.join(fileURLToPath(new URL('../..', import.meta.url)), 'build/web');
const server = await serve({ root });
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    await page.addInitScript(() => localStorage.setItem('drypoint.visited', 'true')); // no hint for newcomers
    await page.goto(`${server.address}#${what}`);
    await page.waitForFunction(() => document.documentElement.dataset.state === 'ready');
    await page.evaluate(() => document.getElementById('part-look').scrollIntoView());
    await page.evaluate(() => {
        // once more: the first picture also waits for the compiler
        const { engine } = window.drypoint;
        const drawn = new Promise((resolve) => engine.addEventListener('frame', ({ detail }) => detail.full && resolve()));
        engine.resize(...['size-width', 'size-height'].map((id) => document.getElementById(id).valueAsNumber));
        return drawn;
    });
    await page.waitForTimeout(500);
    await page.screenshot({ path: positionals[0] });
    execFileSync('convert', [positionals[0], '+dither', '-colors', '256', '-strip', `PNG8:${positionals[0]}`]);
} finally {
    await browser.close();
    await server.close();
}

/* For everyone: no violation that axe-core finds, light and dark, with dialogs open and on a small screen. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from './bench.mjs';

const axe = () => readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

async function violations(visit) {
    await visit.page.evaluate(axe());
    const found = await visit.page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
    return found.violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target}: ${failureSummary}`));
}

const views = {
    light: { colorScheme: 'light' },
    dark: { colorScheme: 'dark' },
    'forced colours': { forcedColors: 'active' },
    'a phone': { viewport: { width: 390, height: 760 }, isMobile: true, hasTouch: true },
};

for (const [name, options] of Object.entries(views)) {
    test(`axe-core finds nothing: ${name}`, async (bench) => {
        const visit = await bench.visit({ reducedMotion: 'reduce', ...options });
        assert.deepEqual(await violations(visit), []);
        await visit.page.focus('#picture');
        await visit.page.keyboard.press('?');
        await visit.page.waitForSelector('#help[open]');
        assert.deepEqual(await violations(visit), [], 'with help');
        await visit.page.keyboard.press('Escape');
        await visit.drop([{ name: 'empty.stl', data: '' }]);
        await visit.message(/empty\.stl/);
        assert.deepEqual(await violations(visit), [], 'with a message');
    });
}

test('everything can be reached by Tab, and what has the focus shows it', async (bench) => {
    const visit = await bench.visit();
    const reached = new Set();
    await visit.page.evaluate(() => document.body.focus());
    for (let i = 0; i < 150; i++) {
        await visit.page.keyboard.press('Tab');
        const at = await visit.page.evaluate(() => {
            const node = document.activeElement;
            if (!node || node === document.body) return null;
            const style = getComputedStyle(node);
            const shown = style.outlineStyle !== 'none' || style.boxShadow !== 'none';
            return { id: node.id || node.className, shown, tag: node.tagName };
        });
        if (!at) break;
        reached.add(at.id);
        assert.ok(at.shown, `nothing shows the focus of ${at.tag} ${at.id}`);
    }
    for (const id of ['picture', 'open', 'save-png', 'save-svg', 'ridge-angle', 'theme', 'preset', 'hidden']) {
        assert.ok(reached.has(id), `Tab does not reach #${id}; it reaches ${[...reached].join(' ')}`);
    }
});

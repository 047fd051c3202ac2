/* Opening the page: the first picture, with and without threads, offline, and what it may not do. */
import assert from 'node:assert/strict';
import { start_server, test } from './bench.mjs';

const about = (visit) => visit.page.evaluate(() => window.drypoint.engine.info);

test('the page opens and draws, on threads', async (bench) => {
    const visit = await bench.visit();
    const ms = await visit.page.evaluate(() => performance.getEntriesByName('first-picture')[0]?.startTime);
    assert.ok(ms > 0 && ms < 10_000, `first picture after ${ms} ms`);
    const info = await about(visit);
    assert.equal(info.isolated, true);
    assert.ok(info.threads >= 1);
    assert.match(await visit.command(), /^drypoint .* -o \S+\.png$/);
    await visit.same_as_program();
    return `first picture after ${Math.round(ms)} ms, ${info.threads} threads`;
});

test('a host that sends no headers gets the build without threads, and the same picture', async (bench) => {
    const visit = await bench.visit();
    const info = await about(visit);
    assert.deepEqual([info.isolated, info.threads], [false, 1]);
    await visit.same_as_program();
    await visit.change(() => visit.page.click('[data-view=front]'));
    await visit.same_as_program();
}, { isolated: false });

for (const isolated of [true, false]) {
    test(`after the first visit the page works offline, ${isolated ? 'on threads' : 'without the headers'}`, async (bench) => {
        const server = await start_server(isolated);
        const visit = await bench.visit({ address: server.address });
        await visit.page.evaluate(() => navigator.serviceWorker.ready);
        const { hash } = await visit.picture();
        await server.close();
        await visit.context.setOffline(true);
        await visit.page.reload();
        await visit.ready();
        assert.equal((await visit.picture()).hash, hash);
        assert.equal((await about(visit)).isolated, true); // the service worker sends the headers
        await visit.change(() => visit.page.click('[data-view=top]'));
        await visit.same_as_program();
    }, { isolated });
}

test('a link opened elsewhere draws the same picture', async (bench) => {
    const visit = await bench.visit({ permissions: ['clipboard-read', 'clipboard-write'] });
    await visit.change(() => visit.page.click('[data-view=right]'));
    await visit.change(() => visit.page.selectOption('#hidden', 'dashed'));
    await visit.change(() => visit.page.fill('.line[data-line=silhouette] input.color', '#c02020'));
    await visit.page.click('#link');
    const link = await visit.page.evaluate(() => navigator.clipboard.readText());
    assert.ok(link.startsWith(bench.address), link);
    const other = await bench.visit({ path: link.slice(bench.address.length) });
    const [a, b] = [await visit.picture(), await other.picture()];
    assert.deepEqual([b.width, b.height, b.hash], [a.width, a.height, a.hash]);
    assert.equal(await other.command(), await visit.command());
});

test('a link that makes no sense is refused with a message, and the page works', async (bench) => {
    for (const path of ['#--ridge-angle banana', '#%ff%fe', '#model=shape:nothing&options=--view', '?shape=no']) {
        const visit = await bench.visit({ path });
        await visit.change(() => visit.page.click('[data-view=left]'));
        visit.check();
    }
});

test('settings are remembered', async (bench) => {
    const visit = await bench.visit();
    await visit.page.selectOption('#theme', 'dark');
    await visit.change(() => visit.page.fill('.line[data-line=silhouette] input.width', '4'));
    const before = await visit.command();
    await visit.page.waitForTimeout(500); // may be written a moment later
    await visit.page.goto(bench.address);
    await visit.ready();
    assert.equal(await visit.page.inputValue('#theme'), 'dark');
    assert.equal(await visit.page.inputValue('.line[data-line=silhouette] input.width'), '4');
    assert.equal(await visit.command(), before);
});

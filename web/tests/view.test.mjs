/* Moving the camera by mouse, keys and touch; undo; looks; sizes; each picture against the native program's. */
import assert from 'node:assert/strict';
import { make_model, test } from './bench.mjs';

async function drag(page, from, to, { button = 'left', steps = 5 } = {}) {
    await page.mouse.move(...from);
    await page.mouse.down({ button });
    await page.mouse.move(...to, { steps });
    await page.mouse.up({ button });
}

async function middle(page) {
    const box = await page.locator('#picture').boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
}

test('mouse: turn, move, zoom, fit', async (bench) => {
    const visit = await bench.visit();
    const [x, y] = await middle(visit.page);
    const seen = new Set([await visit.command()]);
    const moves = [
        () => drag(visit.page, [x, y], [x + 90, y - 40]),
        () => drag(visit.page, [x, y], [x - 60, y + 30], { button: 'right' }),
        async () => {
            await visit.page.keyboard.down('Shift');
            await drag(visit.page, [x, y], [x + 50, y]);
            await visit.page.keyboard.up('Shift');
        },
        async () => {
            await visit.page.mouse.move(x, y);
            await visit.page.mouse.wheel(0, -300);
        },
        () => visit.page.click('#fit'),
    ];
    for (const move of moves) {
        await visit.change(move);
        seen.add(await visit.command());
        await visit.same_as_program();
    }
    assert.equal(seen.size, moves.length + 1);
});

test('keys: turn, move, zoom, views, projection; moves are said', async (bench) => {
    const visit = await bench.visit();
    await visit.page.focus('#picture');
    const keys = ['ArrowLeft', 'ArrowUp', 'Shift+ArrowRight', '+', '-', 'f', '1', '7', 'o'];
    let last = await visit.command();
    for (const key of keys) {
        await visit.change(() => visit.page.keyboard.press(key));
        const command = await visit.command();
        if (key !== 'f') assert.notEqual(command, last, `${key} changed nothing`);
        last = command;
    }
    await visit.same_as_program();
    await visit.page.waitForFunction(() => [...document.querySelectorAll('[aria-live=polite]')].some((node) => node.textContent.trim()), null, { timeout: 5000 });
    assert.ok(await visit.page.isChecked('#ortho'));
});

test('a phone: one finger turns, two zoom, the controls can be reached', async (bench) => {
    const visit = await bench.visit({ viewport: { width: 390, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    const wide = await visit.page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(wide[0] <= wide[1], `the page is ${wide[0]} wide on a screen of ${wide[1]}`);
    const [x, y] = await middle(visit.page);
    const client = await visit.context.newCDPSession(visit.page);
    const touch = (type, ...points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })) });
    let last = await visit.command();
    const changed = async (action, what) => {
        await visit.change(action);
        const command = await visit.command();
        assert.notEqual(command, last, what);
        last = command;
        await visit.same_as_program();
    };
    await changed(async () => {
        await touch('touchStart', [x, y]);
        for (let i = 1; i <= 5; i++) await touch('touchMove', [x + 12 * i, y + 6 * i]);
        await touch('touchEnd');
    }, 'one finger');
    await changed(async () => {
        await touch('touchStart', [x - 30, y], [x + 30, y]);
        for (let i = 1; i <= 5; i++) await touch('touchMove', [x - 30 - 10 * i, y], [x + 30 + 10 * i, y]);
        await touch('touchEnd');
    }, 'two fingers');
    assert.equal(await visit.page.evaluate(() => visualViewport.scale), 1); // the page itself was not zoomed
});

test('undo and redo give the very pictures back', async (bench) => {
    const visit = await bench.visit();
    const states = [[await visit.command(), (await visit.picture()).hash]];
    const note = async () => states.push([await visit.command(), (await visit.picture()).hash]);
    const actions = [
        () => visit.page.click('[data-view=front]'),
        () => visit.page.selectOption('#hidden', { index: 1 }),
        () => visit.page.fill('#ridge-angle', '100'),
        () => visit.page.uncheck('.line[data-line=ridge] input.switch'),
    ];
    for (const action of actions) {
        await visit.change(action);
        await note();
    }
    for (let i = actions.length - 1; i >= 0; i--) {
        await visit.change(() => (i % 2 ? visit.page.keyboard.press('Control+z') : visit.page.click('#undo')));
        assert.deepEqual([await visit.command(), (await visit.picture()).hash], states[i], `undo ${i}`);
    }
    for (let i = 1; i <= actions.length; i++) {
        await visit.change(() => (i % 2 ? visit.page.keyboard.press('Control+Shift+Z') : visit.page.click('#redo')));
        assert.deepEqual([await visit.command(), (await visit.picture()).hash], states[i], `redo ${i}`);
    }
});

test('line classes: colour, width, switch, angles', async (bench) => {
    const visit = await bench.visit();
    await visit.change(() => visit.drop([make_model('boxes', 'boxes.stl')]));
    for (const [line, color] of Object.entries({ silhouette: '#803010', ridge: '#205080', valley: '#108040', intersection: '#a000a0', border: '#808000' })) {
        const row = visit.page.locator(`.line[data-line=${line}]`);
        if (!(await row.locator('input.switch').isChecked())) await row.locator('input.switch').check();
        await row.locator('input.color').fill(color);
        await row.locator('input.width').fill('3');
    }
    await visit.change(() => visit.page.fill('#ridge-angle', '170'));
    await visit.change(() => visit.page.fill('#valley-angle', '190'));
    await visit.page.waitForTimeout(400);
    await visit.ready();
    await visit.same_as_program();
    await visit.change(() => visit.page.uncheck('.line[data-line=silhouette] input.switch'));
    await visit.same_as_program();
});

/* Options of the select by this id but its first, at most `most`. */
async function choices(page, id, most) {
    const values = await page.locator(`#${id} option`).evaluateAll((nodes) => nodes.map((node) => node.value));
    const chosen = values.filter((value, i) => i > 0);
    const step = Math.max(1, Math.floor(chosen.length / most));
    return chosen.filter((value, i) => i % step === 0).slice(0, most);
}

for (const [id, most] of [['preset', 6], ['style', 5], ['stroke', 4], ['hidden', 3], ['detail', 3]]) {
    test(`looks: each #${id} is the program's picture`, async (bench) => {
        const visit = await bench.visit();
        await visit.change(() => visit.drop([make_model('bracket', 'bracket.ply')]));
        const hashes = new Set();
        const values = await choices(visit.page, id, most);
        assert.ok(values.length > 1, `${values.length} choices`);
        for (const value of values) {
            await visit.change(() => visit.page.selectOption(`#${id}`, value));
            hashes.add((await visit.same_as_program()).hash);
        }
        assert.ok(hashes.size > 1, 'they all look alike');
        return values.join(', ');
    });
}

test('another size of the window is another size of the picture', async (bench) => {
    const visit = await bench.visit();
    const before = await visit.picture();
    await visit.change(() => visit.page.setViewportSize({ width: 1280, height: 800 }));
    const after = await visit.same_as_program();
    assert.notDeepEqual([after.width, after.height], [before.width, before.height]);
});

test('the up axis turns the model', async (bench) => {
    const visit = await bench.visit();
    await visit.change(() => visit.drop([make_model('gear', 'gear.stl')]));
    const before = await visit.picture();
    await visit.change(() => visit.page.selectOption('#up', 'y'));
    assert.notEqual((await visit.same_as_program()).hash, before.hash);
});

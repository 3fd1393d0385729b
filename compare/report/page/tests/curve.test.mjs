// The page of a curve, in a browser.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";

import { dots_of, open_fixture } from "./rendered.mjs";

/** @type {Awaited<ReturnType<typeof open_fixture>>} */
let fixture;
/** @type {import("playwright-core").Page} */
let page;

before(async () => {
    fixture = await open_fixture("curve_fixture.tsx");
    page = fixture.page;
});

after(() => fixture.close());

/**
 * The points of a part's path, x and y, on the page.
 * @param {string} section
 * @param {string | number} part
 */
async function points(section, part) {
    const path = await page.locator(`${section} [data-part='${part}'] path`).first().getAttribute("d");
    const numbers = path?.match(/-?[\d.]+(e-?\d+)?/g)?.map(Number) ?? [];
    return numbers.filter((_, i) => i % 2 === 0).map((x, i) => ({ x, y: numbers[2 * i + 1] ?? NaN }));
}

/** @param {string} section */
async function view(section) {
    const text = await page.locator(`${section} .curve-drawing svg`).getAttribute("data-view");
    const [x, y, zoom] = text?.split(" ").map(Number) ?? [];
    return { x: x ?? NaN, y: y ?? NaN, zoom: zoom ?? NaN };
}

test("every part is drawn with the points of the file, in proportion", async () => {
    for (const section of ["#curve", "#huge"]) {
        assert.equal((await points(section, "control")).length, 5);
        assert.equal((await points(section, 1)).length, 8);
        assert.equal((await points(section, 2)).length, 14);
        assert.equal((await points(section, "exact")).length, 98);
        const [a, b, c] = await points(section, "control");
        assert.ok(a && b && c);
        // (0, 0), (1, 2), (3, 2), y up.
        assert.ok(Math.abs((c.x - b.x) / (b.x - a.x) - 2) < 1e-3);
        assert.ok(Math.abs((a.y - b.y) / (b.x - a.x) - 2) < 1e-3);
    }
});

test("a curve in one place is drawn, in the middle", async () => {
    assert.deepEqual((await points("#one-place", "control"))[0], { x: 450, y: 280 });
});

test("a check box hides a level", async () => {
    await page.locator("#curve").getByRole("checkbox", { name: "level 2" }).press("Space");
    assert.equal(await page.locator("#curve [data-part='2']").count(), 0);
    await page.locator("#curve").getByRole("checkbox", { name: "level 2" }).press("Space");
    assert.equal(await page.locator("#curve [data-part='2']").count(), 1);
});

test("the slider moves levels away from the curve, and leaves out what is outside its domain", async () => {
    const before = await points("#curve", 1);
    const control = await points("#curve", "control");
    const slider = page.locator("#curve input[type=range]");
    await slider.focus();
    for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
    assert.equal(await slider.getAttribute("aria-valuetext"), "10 times");
    const now = await points("#curve", 1);
    assert.equal(now.length, before.length - 2);
    assert.deepEqual(await points("#curve", "control"), control);
    // An eighth of a unit from the curve, and then ten times as much.
    const unit = (control[1]?.x ?? NaN) - (control[0]?.x ?? NaN);
    now.forEach((p, i) => {
        assert.ok(Math.abs(p.x - (before[i + 1]?.x ?? NaN)) < 2e-3);
        assert.ok(Math.abs((before[i + 1]?.y ?? NaN) - p.y - 9 / 8 * unit) < 5e-3);
    });
    await page.keyboard.press("Home");
    assert.deepEqual(await points("#curve", 1), before);
});

test("the keyboard moves and zooms the drawing", async () => {
    const pane = page.locator("#curve .curve-drawing");
    const before = (await points("#curve", "control"))[0]?.x ?? NaN;
    await pane.focus();
    await page.keyboard.press("ArrowLeft");
    assert.deepEqual(await view("#curve"), { x: 40, y: 0, zoom: 1 });
    assert.ok(Math.abs(((await points("#curve", "control"))[0]?.x ?? NaN) - before - 40) < 2e-3);
    await page.keyboard.press("+");
    assert.equal((await view("#curve")).zoom, 1.25);
    await page.keyboard.press("0");
    const all = await view("#curve");
    assert.ok(Math.abs(all.x) < 1e-3 && Math.abs(all.y) < 1e-3 && Math.abs(all.zoom - 1) < 1e-6);
});

test("the mouse moves the drawing, and its wheel zooms about the mouse once it has been clicked", async () => {
    const pane = page.locator("#huge .curve-drawing");
    await pane.scrollIntoViewIfNeeded();
    const box = await pane.boundingBox();
    assert.ok(box);
    const scale = 900 / (box.width - 2);
    // Whole pixels: a wheel has no others.
    const [x, y] = [Math.round(box.x) + 200, Math.round(box.y) + 100];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 30, { steps: 3 });
    await page.mouse.up();
    const moved = await view("#huge");
    assert.ok(Math.abs(moved.x - 60 * scale) < 0.01 && Math.abs(moved.y - 30 * scale) < 0.01);
    const at = { x: (x + 60 - box.x - 1) * scale, y: (y + 30 - box.y - 1) * scale };
    await page.mouse.wheel(0, -100);
    await page.locator("#huge .curve-drawing svg[data-view$=' 1.25']").waitFor();
    const now = await view("#huge");
    assert.equal(now.zoom, 1.25);
    assert.ok(Math.abs((at.x - now.x) / now.zoom - (at.x - moved.x) / moved.zoom) < 0.01);
    assert.ok(Math.abs((at.y - now.y) / now.zoom - (at.y - moved.y) / moved.zoom) < 0.01);
});

test("two fingers zoom", async () => {
    const zoom = (await view("#curve")).zoom;
    await page.locator("#curve .curve-drawing").evaluate((pane) => {
        pane.setPointerCapture = () => undefined;  // These pointers are not the browser's.
        const box = pane.getBoundingClientRect();
        const send = (/** @type {string} */ type, /** @type {number} */ pointerId, /** @type {number} */ x) =>
            pane.dispatchEvent(new PointerEvent(type, { pointerId, clientX: box.left + x, clientY: box.top + 50,
                bubbles: true }));
        send("pointerdown", 11, 100);
        send("pointerdown", 12, 200);
        send("pointermove", 12, 300);
        send("pointerup", 11, 100);
        send("pointerup", 12, 300);
    });
    await page.waitForTimeout(50);
    assert.ok(Math.abs((await view("#curve")).zoom / zoom - 2) < 1e-6);
});

test("distances have their bound, and a level beyond it is marked and named", async () => {
    for (const [section, beyond] of /** @type {const} */ ([["#curve", 0], ["#huge", 1]])) {
        const figure = page.locator(`${section} figure`).first();
        assert.equal((await dots_of(figure)).length, 3);
        assert.equal(await figure.locator(".bounds path").count(), 3);
        assert.equal(await figure.locator(".beyond circle, .beyond path").count(), beyond);
        assert.equal((await figure.locator("figcaption").textContent())?.includes("beyond"), beyond === 1);
    }
});

test("verdict, notes, peers and what is left out are in words, and names from a file are text", async () => {
    const text = await page.locator("#curve").textContent();
    for (const part of ["Verdict: \u2248 within rounding.", "A note with <b>markup</b>.",
        "Level 3 (26 points) was checked and is too large for this file.", "opensubdiv"])
        assert.ok(text?.includes(part), part);
    assert.equal(await page.locator("#page script, #page b").count(), 0);
});

test("an accessibility check finds nothing", async () => {
    const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
    await page.evaluate(await readFile(axe, "utf8"));
    const found = await page.evaluate("axe.run().then((r) => r.violations.map((v) => `${v.id}: ${v.nodes[0].html}`))");
    assert.deepEqual(found, []);
});

test("the console is silent", () => {
    assert.deepEqual(fixture.complaints, []);
});

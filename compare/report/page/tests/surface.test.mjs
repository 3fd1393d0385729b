// The parts of a limit page, in a browser.
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
    fixture = await open_fixture("surface_fixture.tsx");
    page = fixture.page;
});

after(() => fixture.close());

/** @param {string} way @param {number} column */
async function cells(way, column) {
    return page.locator(`section[aria-label='${way}'] tbody tr`).evaluateAll((rows, column) =>
        rows.map((row) => row.children[column]?.textContent ?? ""), column);
}

test("ways that differ come first, those without anything last, and beyond its bound a class is on top", async () => {
    assert.deepEqual(await page.locator("section.way h3").allTextContents(), ["patch-box", "bfr", "patch-linear"]);
    assert.deepEqual(await cells("patch-box", 0), ["interior 5", "<script>", "regular"]);
    assert.deepEqual(await cells("bfr", 0), ["regular", "interior 5", "interior 12"]);
});

test("the button of a column sorts every table by keyboard: down, up, and as they came", async () => {
    const header = page.locator("section[aria-label='bfr'] thead th").filter({ hasText: "position error" });
    const button = header.locator("button");
    assert.equal(await header.getAttribute("aria-sort"), "none");
    await button.focus();
    await page.keyboard.press("Enter");
    assert.equal(await header.getAttribute("aria-sort"), "descending");
    assert.deepEqual(await cells("bfr", 0), ["interior 5", "interior 12", "regular"]);
    assert.deepEqual(await cells("patch-box", 0), ["<script>", "interior 5", "regular"]);
    await page.keyboard.press("Enter");
    assert.equal(await header.getAttribute("aria-sort"), "ascending");
    assert.deepEqual(await cells("bfr", 0), ["regular", "interior 12", "interior 5"]);
    await page.keyboard.press("Enter");
    assert.equal(await header.getAttribute("aria-sort"), "none");
    assert.deepEqual(await cells("bfr", 0), ["regular", "interior 5", "interior 12"]);
});

test("names sort by their numbers, and what has no rate comes last both ways", async () => {
    const sort = (/** @type {number} */ column) =>
        page.locator("section[aria-label='bfr'] thead button").nth(column).click();
    await sort(0);
    assert.deepEqual(await cells("bfr", 0), ["regular", "interior 12", "interior 5"]);
    await sort(10);
    assert.deepEqual(await cells("bfr", 10), ["0.5800", "0.4550", ""]);
    await sort(10);
    assert.deepEqual(await cells("bfr", 10), ["0.4550", "0.5800", ""]);
    await sort(10);
});

test("a way is chosen for the model", async () => {
    const pressed = () => page.locator("button[aria-pressed='true']").evaluateAll((buttons) =>
        buttons.map((button) => button.closest("section")?.getAttribute("aria-label")));
    assert.deepEqual(await pressed(), ["bfr"]);
    await page.locator("section[aria-label='patch-box'] button[aria-pressed]").press("Space");
    assert.deepEqual(await pressed(), ["patch-box"]);
});

test("the plot has a mark a way and class, and a dash where a bound is predicted", async () => {
    const marks = await dots_of(page.locator("figure"));
    assert.equal(marks.length, 6);
    assert.equal(await page.locator(".bounds path").count(), 4);
    assert.equal(await page.locator(".beyond circle, .beyond path").count(), 2);
    const y = (/** @type {string} */ title) => marks.find((m) => m.title.startsWith(title))?.y ?? NaN;
    const ascending = ["patch-box, face class regular", "bfr, face class regular", "bfr, face class interior 12",
        "bfr, face class interior 5", "patch-box, face class interior 5", "patch-box, face class <script>"].map(y);
    for (let i = 1; i < ascending.length; ++i) assert.ok(ascending[i] < ascending[i - 1], `mark ${i}`);
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

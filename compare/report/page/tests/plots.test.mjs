// What the plots draw is read back from their SVG, in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { dots_of, open_fixture } from "./rendered.mjs";

/** @type {Awaited<ReturnType<typeof open_fixture>>} */
let fixture;
/** @type {import("playwright-core").Page} */
let page;

before(async () => {
    fixture = await open_fixture("plots_fixture.tsx");
    page = fixture.page;
});

after(() => fixture.close());

/**
 * Attributes of the elements, as numbers.
 * @param {string} selector
 * @param {string[]} names
 */
async function attributes(selector, names) {
    return page.locator(selector).evaluateAll(
        (elements, names) => elements.map((e) => Object.fromEntries(
            names.map((name) => [name, Number(e.getAttribute(name))]))), names);
}

/** @param {string} section */
const dots = (section) => dots_of(page.locator(section));

test("an error plot has a mark a class and level, higher for larger errors", async () => {
    const marks = await dots("#errors figure:nth-of-type(1)");
    assert.equal(marks.length, 7);
    const y = (/** @type {string} */ title) => {
        const mark = marks.find((m) => m.title.startsWith(title));
        assert.ok(mark, title);
        return mark.y;
    };
    const ascending = ["interior 5, level 0: 0", "<script>, level 2: 1.00e-300", "interior 5, level 1: 1.5",
        "interior 5, level 2: 3", "interior 12, level 1: 1.00e+13", "interior 12, level 2: not finite"].map(y);
    for (let i = 1; i < ascending.length; ++i) assert.ok(ascending[i] < ascending[i - 1], `mark ${i}`);
});

test("identical and not finite have their own places, which are named", async () => {
    const figure = page.locator("#errors figure:nth-of-type(1)");
    const middle = async (/** @type {import("playwright-core").Locator} */ element) => {
        const box = await element.boundingBox();
        return (box?.y ?? NaN) + (box?.height ?? NaN) / 2;
    };
    for (const [name, of] of [["identical", "interior 5, level 0"], ["not finite", "interior 12, level 2"]]) {
        const label = figure.locator("svg[role=img] text").filter({ hasText: name ?? "" });
        const mark = figure.locator(".dots path").filter({ hasText: of ?? "" });
        assert.ok(Math.abs((await middle(label)) - (await middle(mark))) < 6, name);
    }
});

test("what is beyond its bound is above the dashed line and has a ring; what is within is below", async () => {
    const figure = "#errors figure:nth-of-type(1)";
    const marks = await dots(figure);
    const bounds = await page.locator(`${figure} .bounds path`).evaluateAll((paths) => paths.map((path) =>
        Number((path.getAttribute("d") ?? "").match(/^M[^,]+,([^L]+)/)?.[1])));
    assert.equal(bounds.length, marks.length);
    marks.forEach((mark, i) => {
        const beyond = mark.title.includes("e+13") || mark.title.includes("not finite");
        if (beyond) assert.ok(mark.y < bounds[i], mark.title);
        else assert.ok(mark.y >= bounds[i], mark.title);
    });
    assert.equal(await page.locator(`${figure} .beyond circle, ${figure} .beyond path`).count(), 2);
});

test("limits have a plot of their own", async () => {
    assert.equal(await page.locator("#errors figure").count(), 2);
    const marks = await dots("#errors figure:nth-of-type(2)");
    assert.deepEqual(marks.map((mark) => mark.title), ["dart, level 0: 0.25, bound 2"]);
});

test("every plot has a title, a sentence, a label and its numbers as a table", async () => {
    const figures = await page.locator("figure").all();
    for (const figure of figures) {
        assert.notEqual(await figure.locator("figcaption strong").textContent(), "");
        assert.notEqual(await figure.locator("figcaption span").textContent(), "");
        const label = await figure.locator("svg[role=img]").getAttribute("aria-label");
        assert.ok(label?.startsWith((await figure.locator("figcaption strong").textContent()) ?? "-"));
        assert.ok(await figure.locator("details tbody tr").count() > 0);
    }
});

test("names from a file are text", async () => {
    assert.equal(await page.locator("figure script").count(), 0);
    assert.ok((await page.locator("#errors").textContent())?.includes("<script>alert(1)</script>"));
});

test("a histogram counts every value once, the identical and the not finite apart", async () => {
    const rows = await page.locator("#histogram tbody tr").evaluateAll((rows) => rows.map((row) =>
        [...row.children].map((cell) => cell.textContent ?? "")));
    assert.deepEqual(rows, [["identical", "3"], ["0.316 to 1 u M", "2"], ["1 to 3.16 u M", "3"],
        ["3.16 to 10 u M", "0"], ["10 to 31.6 u M", "0"], ["31.6 to 100 u M", "1"], ["not finite", "2"]]);
    const bars = await attributes("#histogram .bars rect", ["x", "width", "height"]);
    assert.equal(bars.length, rows.length);
    bars.forEach((bar, i) => {
        const others = bars.filter((_, j) => Number(rows[j]?.[1]) > Number(rows[i]?.[1]));
        for (const other of others) assert.ok((other["height"] ?? 0) > (bar["height"] ?? 0));
    });
    const ends = bars.map((bar) => (bar["x"] ?? 0) + (bar["width"] ?? 0));
    assert.ok((bars[1]?.["x"] ?? 0) > (ends[0] ?? 0) + 10, "the identical stand apart");
    assert.ok((bars.at(-1)?.["x"] ?? 0) > (ends.at(-2) ?? 0) + 10, "the not finite stand apart");
});

test("a histogram over every magnitude has few bins", async () => {
    const bars = await attributes("#extreme .bars rect", ["width"]);
    assert.ok(bars.length <= 32);
    for (const bar of bars) assert.ok((bar["width"] ?? 0) > 4);
});

test("a guide has the slope of its factor and ends at the last point that has a logarithm", async () => {
    const marks = await dots("#convergence");
    assert.equal(marks.length, 12);
    const guides = await page.locator("#convergence .guides path").evaluateAll((paths) => paths.map((path) =>
        (path.getAttribute("d") ?? "").match(/-?[\d.]+/g)?.map(Number) ?? []));
    assert.equal(guides.length, 2);
    const of_class = (/** @type {string} */ name) => marks.filter((mark) => mark.title.startsWith(name));
    // Both fall by their factor at every level, so that guides go through all points.
    const expected = [of_class("crease").slice(0, 3), of_class("interior 5")];
    expected.forEach((points, i) => {
        const first = points[0], last = points.at(-1);
        [first?.x, first?.y, last?.x, last?.y].forEach((value, k) =>
            assert.ok(Math.abs((value ?? NaN) - (guides[i]?.[k] ?? NaN)) < 1e-2, `guide ${i}`));
    });
});

test("of too many classes the largest are drawn, and the table has all", async () => {
    assert.equal((await dots("#many")).length, 12);
    assert.equal(await page.locator("#many tbody tr").count(), 40);
    assert.ok((await page.locator("#many figcaption").textContent())?.includes("12 series of 40"));
});

test("plots have the same height before and after they are drawn, and as wide as the page", async () => {
    for (const width of [400, 1200]) {
        await page.setViewportSize({ width, height: 700 });
        await page.waitForFunction(() => {
            const canvas = document.querySelector(".plot-canvas");
            return canvas?.firstElementChild?.clientWidth === canvas?.clientWidth;
        });
        const canvas = await page.locator(".plot-canvas").first().boundingBox();
        assert.equal(canvas?.height, 340);
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
    }
});

test("tables of numbers open by keyboard", async () => {
    const details = page.locator("#histogram details");
    await details.locator("summary").focus();
    await page.keyboard.press("Enter");
    assert.ok(await details.locator("table").isVisible());
});

test("the console is silent", () => {
    assert.deepEqual(fixture.complaints, []);
});

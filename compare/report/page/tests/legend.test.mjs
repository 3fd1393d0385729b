import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { build } from "esbuild";

import { bundle, launch, open_page } from "./support.mjs";

/** @type {import("playwright-core").Browser} */
let browser;
/** @type {string} */
let html;
before(async () => {
    browser = await launch();
    const style = await build({
        entryPoints: [new URL("../src/style.css", import.meta.url).pathname], bundle: true, write: false,
    });
    html = `<!doctype html><html lang="en"><title>Legends</title><meta charset="utf-8"><link rel="icon" href="data:,">
        <style>${style.outputFiles[0]?.text}</style><main><h1>Legends</h1><div id="host"></div></main>
        <script>${await bundle("tests/legend.entry.ts", "loopcheck")}</script>`;
});
after(() => browser.close());

/** @param {string} scale as JavaScript @param {string} [title] */
const shown = (scale, title = "Error") =>
    `loopcheck.show(${scale}, ${JSON.stringify(title)}, document.getElementById("host"))`;
const errors = 'new loopcheck.ErrorScale({ least: 0.01, largest: 100 }, "u M")';
const nothing = 'new loopcheck.ErrorScale(null, "u M")';

test("a legend of errors says the unit, the decades and what is off the ramp", async () => {
    const { page, complaints, close } = await open_page(browser, html);
    await page.evaluate(shown(errors));
    const text = await page.innerText("#host");
    for (const part of ["Error, in u M", "0.01", "0.1", "1", "10", "100", "identical", "not finite"]) {
        assert.ok(text.includes(part), `${part} in ${text}`);
    }
    assert.match(text, /from dark, 0.01 u M, to bright, 100 u M/);
    assert.deepEqual(complaints, []);
    await close();
});

test("a legend of errors is as high without any", async () => {
    const { page, close } = await open_page(browser, html);
    const height = async () => (await page.locator(".legend").boundingBox())?.height;
    await page.evaluate(shown(errors));
    const before_change = await height();
    await page.evaluate(shown(nothing));
    assert.equal(await height(), before_change);
    assert.match(await page.innerText("#host"), /no positive value/);
    await close();
});

test("a legend of classes shows names as they are", async () => {
    const { page, close } = await open_page(browser, html);
    await page.evaluate(shown('new loopcheck.ClassScale(["none", "interior 6", "<script>alert(1)</script>"])', "<b>"));
    assert.deepEqual(await page.locator(".legend li").allInnerTexts(),
        ["none", "interior 6", "<script>alert(1)</script>"]);
    assert.equal(await page.innerText("figcaption"), "<b>");
    const fills = await page.locator(".legend rect").evaluateAll((all) => all.map((rect) => rect.getAttribute("fill")));
    assert.deepEqual(fills, ["rgb(196 200 204)", "rgb(0 114 178)", "rgb(230 159 0)"]);
    await close();
});

for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
    test(`legends have no barrier that axe finds, ${colorScheme}`, async () => {
        const { page, close } = await open_page(browser, html, { colorScheme });
        await page.addScriptTag({ path: createRequire(import.meta.url).resolve("axe-core") });
        for (const scale of [errors, nothing, 'new loopcheck.ClassScale(["none", "interior 6"])']) {
            await page.evaluate(shown(scale));
            assert.deepEqual(await page.evaluate("axe.run().then((result) => result.violations)"), []);
        }
        await close();
    });
}

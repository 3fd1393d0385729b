// Reports that loopcheck wrote, opened in a browser, and their numbers read back against its JSON.
//
// LOOPCHECK   the program; LOOPCHECK_MODELS   the folder of models
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";

import { chunk, report_file } from "./fixture.mjs";
import { bundled_page, launch, open_file } from "./support.mjs";

const program = process.env["LOOPCHECK"] ?? "";
const models = process.env["LOOPCHECK_MODELS"] ?? "";
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const folder = mkdtempSync(join(tmpdir(), "loopcheck-page-"));

/** @type {import("playwright-core").Browser} */
let browser;
before(async () => {
    browser = await launch();
});
after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
});

/**
 * Runs loopcheck with a report beside, whatever the verdict.
 * @param {string} name of the files
 * @param {string[]} command
 */
function report(name, command) {
    const html = join(folder, `${name}.html`);
    const json = join(folder, `${name}.json`);
    try {
        execFileSync(program, [...command, "--html", html, "--json", json], { stdio: "pipe" });
    } catch (error) {
        const status = /** @type {{ status?: number }} */ (error).status;
        assert.equal(status, 1, `loopcheck ${command.join(" ")}: ${error}`);
    }
    return { html, json: JSON.parse(readFileSync(json, "utf8")) };
}

/** @param {string} model */
const model = (model) => join(models, model);

/**
 * Opens a report file.
 * @param {string} html with its address within the report, if any
 * @param {{ colorScheme?: "light" | "dark", width?: number }} options
 */
async function open(html, { colorScheme = "light", width = 1400 } = {}) {
    const opened = await open_file(browser, html,
        { viewport: { width, height: 1000 }, colorScheme, reducedMotion: "reduce" });
    await opened.page.locator("h1, [role=alert]").first().waitFor();
    return opened;
}

/** @param {import("playwright-core").Page} page */
async function accessibility(page) {
    await page.evaluate(axe);
    const result = await page.evaluate("axe.run()");
    return /** @type {{ violations: { id: string, nodes: { html: string }[] }[] }} */ (result).violations.map(
        (one) => `${one.id}: ${one.nodes.map((node) => node.html).slice(0, 3).join("; ")}`);
}

/**
 * @param {import("playwright-core").Page} page
 * @param {number} vertex
 */
async function select(page, vertex) {
    await page.getByLabel("Vertex", { exact: true }).fill(String(vertex));
    await page.getByRole("button", { name: "Go" }).click();
    await page.locator(`[data-vertex="${vertex}"]`).waitFor();
}

/**
 * @param {import("playwright-core").Page} page
 * @param {number} level
 */
async function set_level(page, level) {
    await page.getByRole("slider", { name: /Level/ }).fill(String(level));
    await page.locator(".level b", { hasText: String(level) }).waitFor();
}

/** @param {import("playwright-core").Page} page */
const next_frame = (page) => page.evaluate(() => new Promise(requestAnimationFrame));

test("worst vertices of every level read as in the JSON", async () => {
    for (const [name, file, ...more] of [
        ["cow", "cow.obj"], ["warren", "icosahedron.obj", "--weights", "warren"], ["creased", "cow-creased.obj"],
    ]) {
        const command = ["compare", model(file ?? ""), "--levels", "3", "--top", "3", ...more];
        const { html, json } = report(name ?? "", command);
        const { page, complaints, close } = await open(html);
        const [comparison] = json.comparisons;
        for (const level of comparison.levels) {
            await set_level(page, level.level);
            for (const worst of level.worst) {
                await select(page, worst.vertex);
                const cells = page.locator(".points").first();
                for (const [who, key] of [[comparison.subject, "subject"], [comparison.reference, "reference"],
                    ["exact", "exact"]])
                    assert.deepEqual(await cells.locator(`[data-who="${who}"] code`).allTextContents(),
                        worst[key].hex, `${name} level ${level.level} vertex ${worst.vertex} ${who}`);
                assert.equal(await page.locator("[data-field=class]").textContent(), worst.class);
                if (level.level > 0) assert.equal(await page.locator("[data-field=rule]").textContent(), worst.rule);
                assert.equal(Number(await page.locator("[data-field=error]").getAttribute("data-value")), worst.error);
            }
        }
        assert.deepEqual(complaints, []);
        await close();
    }
});

test("the slider shows each level with its counts, also by keyboard", async () => {
    const { html, json } = report("levels", ["compare", model("torus.obj"), "--levels", "3"]);
    const { page, complaints, close } = await open(html);
    const slider = page.getByRole("slider", { name: /Level/ });
    await slider.focus();
    await page.keyboard.press("Home");
    for (const level of json.comparisons[0].levels) {
        const text = await page.locator(".counts").textContent();
        const digits = (text ?? "").replace(/[^\d,]/g, "").split(",").map(Number);
        assert.deepEqual(digits, [level.all.vertices ?? level.classes.reduce(
            (/** @type {number} */ sum, /** @type {{ vertices: number }} */ one) => sum + one.vertices, 0), level.faces]);
        await page.keyboard.press("ArrowRight");
    }
    assert.deepEqual(complaints, []);
    await close();
});

test("a click on the surface selects the vertex under it", async () => {
    const { html } = report("click", ["compare", model("icosahedron.obj"), "--levels", "1"]);
    const { page, complaints, close } = await open(html);
    await page.getByRole("slider", { name: /Level/ }).fill("0");
    for (const vertex of [3, 7]) {
        await select(page, vertex);  // flies there: it is in the middle
        const box = await page.locator(".canvas").boundingBox();
        assert.ok(box);
        const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
        const shown = page.locator("[data-vertex]");
        // Near a neighbour, some of which are hidden, and then a little beside the middle.
        for (let i = 0; i < 12; ++i) {
            const angle = (i * Math.PI) / 6;
            await page.mouse.click(middle.x + 50 * Math.cos(angle), middle.y + 50 * Math.sin(angle));
            for (let frame = 0; frame < 3; ++frame) await next_frame(page);  // until the selection is shown
            if ((await shown.getAttribute("data-vertex")) !== String(vertex)) break;
        }
        assert.notEqual(await shown.getAttribute("data-vertex"), String(vertex));
        await page.mouse.click(middle.x + 12, middle.y + 9);
        await page.locator(`[data-vertex="${vertex}"]`).waitFor();
        assert.equal(await shown.count(), 1);
    }
    assert.deepEqual(complaints, []);
    await close();
});

test("a vertex has the colour that the legend gives its class", async () => {
    const { html } = report("colours", ["compare", model("cow.obj"), "--levels", "2"]);
    const { page, complaints, close } = await open(html);
    await page.locator("select").selectOption("class");
    await page.getByLabel("shading").uncheck();
    const seen = new Set();
    for (const vertex of [0, 20, 40, 60, 80, 100, 120]) {
        await select(page, vertex);
        const vertex_class = (await page.locator("[data-field=class]").textContent()) ?? "";
        const fill = await page.locator(".legend li", { hasText: new RegExp(`^${vertex_class}$`) }).locator("rect")
            .getAttribute("fill");
        // Beside the marker, which is on the vertex in the middle, as soon as it is drawn.
        const colour = () => page.evaluate((beside) => {
            const view = document.querySelector("canvas.viewer");
            if (!(view instanceof HTMLCanvasElement)) throw new Error("There is no view.");
            const copy = new OffscreenCanvas(view.width, view.height).getContext("2d");
            copy?.drawImage(view, 0, 0);
            const at = copy?.getImageData(view.width / 2 + beside, view.height / 2, 1, 1).data;
            return `rgb(${[...(at ?? [])].slice(0, 3).join(" ")})`;
        }, 14);
        for (let frame = 0; frame < 60 && (await colour()) !== fill; ++frame) await next_frame(page);
        assert.equal(await colour(), fill, `vertex ${vertex}, ${vertex_class}`);
        seen.add(fill);
    }
    assert.ok(seen.size >= 3, `${seen.size} classes`);
    assert.deepEqual(complaints, []);
    await close();
});

// One second is what the page promises; V8, the software renderer and the other tests share two cores, so the best of
// three attempts counts. Seen: 0.4 s.
test("a mesh of 100 000 vertices never freezes the page for a second", async (context) => {
    const side = 317;
    const lines = [];
    for (let i = 0; i < side; ++i)
        for (let j = 0; j < side; ++j) lines.push(`v ${i} ${j} ${3 * Math.sin(i / 9) * Math.cos(j / 7)}`);
    for (let i = 0; i + 1 < side; ++i)
        for (let a = i * side + 1; a < (i + 1) * side; ++a)
            lines.push(`f ${a} ${a + side} ${a + side + 1}`, `f ${a} ${a + side + 1} ${a + 1}`);
    const path = join(folder, "large.obj");
    writeFileSync(path, lines.join("\n"));
    const { html } = report("large", ["compare", path, "--levels", "0", "--html-vertices", String(side * side)]);
    let best = Infinity;
    for (let attempt = 0; attempt < 3 && !(best < 1000); ++attempt) {
        const page = await browser.newPage({ viewport: { width: 1400, height: 1000 }, reducedMotion: "reduce" });
        await page.addInitScript(() => {
            const longest = { ms: 0 };
            Object.assign(globalThis, { longest });
            new PerformanceObserver((list) => {
                for (const task of list.getEntries()) longest.ms = Math.max(longest.ms, task.duration);
            }).observe({ type: "longtask", buffered: true });
        });
        await page.goto(`file://${html}`);
        await page.locator(".plots svg").first().waitFor();
        await page.locator("select").selectOption("class");
        await page.getByLabel("wireframe").check();
        await page.getByLabel("side by side").check();
        await select(page, 5000);
        best = Math.min(best, await page.evaluate(() => /** @type {{ ms: number }} */ (Reflect.get(globalThis, "longest")).ms));
        await page.close();
    }
    context.diagnostic(`longest task ${best} ms`);
    assert.ok(best < 1000, `${best} ms`);
});

test("masks are fractions that sum to 1", async () => {
    const { html } = report("mask", ["compare", model("icosahedron.obj"), "--levels", "1"]);
    const { page, close } = await open(html);
    await select(page, 2);
    const weights = await page.locator("[data-field=weight]").allTextContents();
    assert.equal(weights.length, 6);
    const sum = weights.reduce((sum, text) => {
        const [p, q = "1"] = text.split("/");
        return sum + Number(p) / Number(q);
    }, 0);
    assert.ok(Math.abs(sum - 1) < 6 * Number.EPSILON, `${weights} sum to ${sum}`);
    await close();
});

test("every cell of the table leads to its case, with the verdict of the JSON", async () => {
    const files = ["tetrahedron.obj", "boundary-corner-4-faces.obj", "cow-creased.obj"].map(model);
    const { html, json } = report("suite", ["suite", ...files, "--levels", "2"]);
    const { page, complaints, close } = await open(html);
    assert.match(await page.locator("h1").innerText(), new RegExp(json.summary.slice(0, 40)));
    /** @type {Map<string, number>} */
    const counts = new Map();
    for (const one of json.comparisons)
        for (const verdict of [one.verdict, one.limits?.verdict])
            if (verdict) counts.set(verdict, (counts.get(verdict) ?? 0) + 1);
    const labels = await page.locator(".results td a").evaluateAll(
        (links) => links.map((link) => link.getAttribute("aria-label") ?? ""));
    for (const [verdict, count] of counts)
        assert.equal(labels.filter((label) => label.includes(`: ${verdict}`)).length, count, verdict);
    const links = await page.locator(".results td a").evaluateAll(
        (links) => links.map((link) => [link.getAttribute("href") ?? "", link.getAttribute("aria-label") ?? ""]));
    for (const [href, label] of links.filter((_, i) => i % 7 === 0)) {
        await page.goto(`file://${html}${href}`);
        await page.locator("#case", { hasText: (label ?? "").split(",")[0] ?? "" }).waitFor();
        assert.ok((label ?? "").includes(await page.locator(".notes .verdict").innerText().then(
            (text) => text.replace(/^\S+\s/, ""))), label);
    }
    assert.deepEqual(complaints, []);
    await close();
});

test("the table puts failures first, filters, sorts, and is walked by arrow keys", async () => {
    const result = (/** @type {string} */ verdict) => ({
        subject: "ours", reference: "peer", what: "refinement", verdict, deviations: [], largest: 1, largest_in_uM: 2,
        notes: [],
    });
    const one = (/** @type {string} */ name, /** @type {string} */ verdict) => ({
        model: name, boundary: "none", creasing: "uniform", weights: "loop", vertices: 4, faces: 4, boundary_edges: 0,
        results: [result(verdict)],
    });
    const header = {
        version: "0", command: "suite", exit_code: 1, sentence: "differs", levels: 1, subjects: [], deviations: [],
        unreadable: [], cases: [one("a", "identical"), one("b", "known deviation"), one("c", "differs"), one("d", "failed")],
    };
    const html = join(folder, "fixture.html");
    writeFileSync(html, report_file(await bundled_page(), { report: chunk(header) }));
    const { page, complaints, close } = await open(html);
    const names = () => page.locator(".results tbody th a").allTextContents();
    assert.deepEqual(await names(), ["d", "c", "b", "a"]);
    await page.getByRole("button", { name: "model" }).click();
    assert.deepEqual(await names(), ["a", "b", "c", "d"]);
    assert.equal(await page.locator("th", { hasText: "model" }).first().getAttribute("aria-sort"), "ascending");
    await page.getByRole("checkbox", { name: "differs" }).check();
    assert.deepEqual(await names(), ["c"]);
    await page.getByRole("checkbox", { name: "differs" }).uncheck();
    await page.getByRole("searchbox").fill("B");
    assert.deepEqual(await names(), ["b"]);
    await page.getByRole("searchbox").fill("");
    await page.locator(".results tbody a[tabindex='0']").focus();
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.evaluate(() => document.activeElement?.getAttribute("href")), "#/case/1/0");
    assert.deepEqual(complaints, []);
    await close();
});

test("no accessibility rule is broken, in light and dark, wide and narrow", async () => {
    const cow = report("axe-cow", ["compare", model("cow-creased.obj"), "--levels", "2", "--limit"]).html;
    const suite = report("axe-suite", ["suite", model("tetrahedron.obj"), model("crease-straight.obj"), "--levels", "1"]).html;
    const limit = report("axe-limit", ["limit", model("icosahedron.obj")]).html;
    const curve = report("axe-curve", ["curve", model("curves/ring.txt"), "--closed", "--levels", "3"]).html;
    for (const html of [cow, suite, `${suite}#/case/0/0`, limit, curve])
        for (const colorScheme of /** @type {const} */ (["light", "dark"]))
            for (const width of [1400, 420]) {
                const { page, complaints, close } = await open(html, { colorScheme, width });
                if (html !== suite) await page.locator(".case .plots, .case svg").first().waitFor();
                assert.deepEqual(await accessibility(page), [], `${html} ${colorScheme} ${width}`);
                assert.deepEqual(complaints, []);
                await close();
            }
});

test("a way of evaluation that is asked for is brought into view", async () => {
    const { html } = report("ways", ["limit", model("icosahedron.obj")]);
    const { page, complaints, close } = await open(html);
    await page.getByRole("button", { name: /Show on the model/ }).nth(3).click();
    await page.waitForFunction(() => location.hash === "#/case/0/3"
        && Math.abs(document.getElementById("case")?.getBoundingClientRect().top ?? Infinity) < 5);
    assert.deepEqual(complaints, []);
    await close();
});

test("names from outside are text", async () => {
    // The path holds a closing tag.
    const path = join(folder, "<img src=x onerror=alert(1)><script>alert(2)<", "script>.obj");
    mkdirSync(dirname(path));
    copyFileSync(model("tetrahedron.obj"), path);
    const { html } = report("hostile", ["compare", path, "--levels", "1"]);
    const { page, complaints, close } = await open(html);
    assert.equal(await page.locator("#case").innerText(), path);
    assert.equal(await page.locator("img").count(), 0);
    assert.deepEqual(complaints, []);
    await close();
});

test("a damaged report says so", async () => {
    const html = join(folder, "damaged.html");
    writeFileSync(html, report_file(await bundled_page(), { report: chunk({}).slice(0, 40) }));
    const { page, close } = await open(html);
    assert.match(await page.locator("[role=alert]").innerText(), /cannot be shown/);
    await close();
});

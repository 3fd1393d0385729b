// Opens a fixture, a module that renders into #page, with the style of the page; and reads plots.
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { chromium } from "playwright-core";

const root = fileURLToPath(new URL("..", import.meta.url));
const kArguments = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--no-first-run",
    "--disable-background-networking", "--disable-component-update"];

/** @param {string} entry */
async function bundled(entry) {
    const result = await build({ entryPoints: [root + entry], bundle: true, write: false, target: "es2022",
        format: "esm", jsx: "automatic", jsxImportSource: "preact" });
    return result.outputFiles[0]?.text ?? "";
}

/**
 * @param {string} name in tests/
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function open_fixture(name, options = {}) {
    const browser = await chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
        args: kArguments });
    const page = await browser.newPage({ viewport: { width: 900, height: 700 }, ...options });
    /** @type {string[]} */
    const complaints = [];
    page.on("console", (message) => complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(error.message));
    await page.setContent(`<!doctype html><html lang="en"><title>${name}</title>
        <style>${await bundled("src/style.css")}</style><body><main><h1>${name}</h1><div id="page"></div></main></body></html>`);
    await page.addScriptTag({ content: await bundled(`tests/${name}`), type: "module" });
    await page.waitForSelector("#page svg");
    return { page, complaints, close: () => browser.close() };
}

/**
 * Where the symbols of plots are, with their titles.
 * @param {import("playwright-core").Locator} within
 */
export async function dots_of(within) {
    return within.locator(".dots path").evaluateAll((paths) => paths.map((path) => {
        const [x, y] = (path.getAttribute("transform") ?? "").match(/-?[\d.]+/g)?.map(Number) ?? [];
        return { x: x ?? NaN, y: y ?? NaN, title: path.querySelector("title")?.textContent ?? "" };
    }));
}

// What tests of the page share.
import { execFileSync } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";
import { chromium } from "playwright-core";

/** @typedef {import("playwright-core").Page} Page */

const page_folder = fileURLToPath(new URL("..", import.meta.url));

/**
 * A module of the page as one JavaScript text; with a name, as a script that sets this global.
 * @param {string} path in the folder of the page
 * @param {string} [global]
 */
export async function bundle(path, global) {
    const result = await build({
        entryPoints: [join(page_folder, path)],
        bundle: true,
        write: false,
        target: "es2022",
        jsx: "automatic",
        jsxImportSource: "preact",
        logLevel: "warning",
        ...(global === undefined ? { format: "esm" } : { format: "iife", globalName: global }),
    });
    return result.outputFiles[0]?.text ?? "";
}

/**
 * A TypeScript module, to be called from a test.
 * @param {string} path in the folder of the page
 */
export async function import_ts(path) {
    const folder = await mkdtemp(join(tmpdir(), "loopcheck-page-"));
    try {
        const file = join(folder, "module.mjs");
        await writeFile(file, await bundle(path));
        return await import(pathToFileURL(file).href);
    } finally {
        await rm(folder, { recursive: true });
    }
}

/** The browser of CHROMIUM, else Debian's, without a graphics card. */
export function launch() {
    return chromium.launch({
        executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
        args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader",
            "--disable-background-networking", "--disable-component-update", "--no-first-run"],
    });
}

/**
 * A page from a text, as `open_file`.
 * @param {import("playwright-core").Browser} browser
 * @param {string} html
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function open_page(browser, html, options = {}) {
    const folder = await mkdtemp(join(tmpdir(), "loopcheck-page-"));
    const file = join(folder, "page.html");
    await writeFile(file, html);
    const opened = await open_file(browser, file, options);
    return {
        ...opened,
        close: async () => {
            await opened.close();
            await rm(folder, { recursive: true });
        },
    };
}

/**
 * A page from a file. Errors and warnings of its console, dialogs, and requests for anything else, are collected in
 * `complaints`.
 * @param {import("playwright-core").Browser} browser
 * @param {string} file with its address within the page, if any
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function open_file(browser, file, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, ...options });
    const page = await context.newPage();
    /** @type {string[]} */
    const complaints = [];
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("console", (message) => {
        // Reading pixels back waits for the renderer: that is what a test wants.
        if (/GPU stall due to ReadPixels/.test(message.text())) return;
        if (["error", "warning"].includes(message.type())) complaints.push(message.text());
    });
    page.on("dialog", (dialog) => {
        complaints.push(dialog.message());
        void dialog.dismiss();
    });
    page.on("request", (request) => {
        if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
    });
    const [path = "", address] = file.split("#");
    const url = pathToFileURL(path).href + (address === undefined ? "" : `#${address}`);
    await page.goto(url);
    return { page, url, complaints, close: () => context.close() };
}

/** The page without a report in it. */
export async function bundled_page() {
    const folder = await mkdtemp(join(tmpdir(), "loopcheck-page-"));
    try {
        const output = join(folder, "page.html");
        execFileSync(process.execPath, [join(page_folder, "build.mjs"), output]);
        return await readFile(output, "utf8");
    } finally {
        await rm(folder, { recursive: true });
    }
}

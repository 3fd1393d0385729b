// node screenshots.mjs LOOPCHECK MODELS OUTPUT: draws the pictures of HTML reports in README.md and docs/.  Run by
// scripts/figures.
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";

import { launch, open_file } from "./tests/support.mjs";

const [program = "", models = "", output = ""] = process.argv.slice(2);
const cwd = dirname(resolve(models));  // names in the pictures are as from the root of the project
const folder = mkdtempSync(join(tmpdir(), "loopcheck-screenshots-"));
const browser = await launch();

/**
 * @param {string} name of the picture
 * @param {string[]} command
 * @param {number} height
 * @param {(page: import("playwright-core").Page) => Promise<void>} prepare
 */
async function shoot(name, command, height, prepare) {
    const html = join(folder, `${name}.html`);
    const run = spawnSync(resolve(program), [...command, "--html", html], { cwd, encoding: "utf8" });
    if (run.status !== 0 && run.status !== 1) throw new Error(run.stderr);  // 1: the subjects differ
    const { page, close } = await open_file(browser, html,
        { viewport: { width: 1400, height }, colorScheme: "light", reducedMotion: "reduce" });
    await page.locator("#results").waitFor();
    await prepare(page);
    await page.waitForTimeout(500);  // the last picture is drawn
    await page.screenshot({ path: join(output, `${name}.png`) });
    await close();
}

/** @param {import("playwright-core").Page} page */
const to_case = (page) => page.evaluate(() => document.getElementById("case")?.scrollIntoView());

await shoot("report-table", ["suite", basename(models), "--levels", "3", "--jobs", "2"], 760, async () => {});
await shoot("report-cow", ["compare", join(basename(models), "cow.obj"), "--weights", "warren", "--levels", "3"], 1060,
    async (page) => {
        await page.locator(".worst button").first().click();
        await page.getByRole("button", { name: "Whole model" }).click();
        await to_case(page);
    });
await shoot("report-deviation", ["compare", join(basename(models), "cow-creased.obj"), "--limit", "--levels", "2"], 960,
    async (page) => {
        await page.getByRole("link", { name: /limits/ }).last().click();
        await page.getByRole("slider", { name: /Level/ }).fill("1");
        await page.locator(".worst button").first().click();
        await page.locator("select").selectOption("deviation");
        await to_case(page);
    });
await browser.close();
rmSync(folder, { recursive: true });

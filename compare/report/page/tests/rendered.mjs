// Opens a fixture, a module that renders into #page, with the style of the page; and reads plots.
import { bundle, launch, open_page } from "./support.mjs";

/**
 * @param {string} name in tests/
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function open_fixture(name, options = {}) {
    const script = (await bundle(`tests/${name}`)).replaceAll("</script", "<\\/script");
    const html = `<!doctype html><html lang="en"><meta charset="utf-8"><title>${name}</title>
        <style>${await bundle("src/style.css")}</style>
        <body><main><h1>${name}</h1><div id="page"></div></main><script type="module">${script}</script></body></html>`;
    const browser = await launch();
    const opened = await open_page(browser, html, options);
    await opened.page.waitForSelector("#page svg");
    return {
        page: opened.page,
        complaints: opened.complaints,
        close: async () => {
            await opened.close();
            await browser.close();
        },
    };
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

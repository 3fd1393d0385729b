// node build.mjs OUTPUT [--source] [--depfile FILE]: bundles the page into one HTML file without anything from outside,
// or, with --source, into the C++ source that has the same for compare/report/html/page.h; and says in FILE what OUTPUT was made of.
import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { build } from "esbuild";

const here = (/** @type {string} */ path) => fileURLToPath(new URL(path, import.meta.url));

/** @type {Set<string>} */
const inputs = new Set();

async function bundled(/** @type {string} */ entry) {
    const result = await build({
        entryPoints: [here(entry)],
        bundle: true,
        minify: true,
        write: false,
        metafile: true,
        absWorkingDir: here("."),
        format: "esm",
        target: "es2022",
        jsx: "automatic",
        jsxImportSource: "preact",
        legalComments: "inline",
        logLevel: "warning",
    });
    for (const input of Object.keys(result.metafile.inputs)) inputs.add(here(input));
    return result.outputFiles[0].text;
}

// Literals of more than 65536 bytes are beyond what compilers must take; adjacent ones are one. In an array, because its
// length is too much for the compiler to count.
function source(/** @type {string} */ text) {
    const pieces = [];
    for (let at = 0; at < text.length; at += 16000) pieces.push(`R"~~~~(${text.slice(at, at + 16000)})~~~~"\n`);
    return `#include "compare/report/html/page.h"
namespace {
constexpr char kText[] =
${pieces.join("")};
}
namespace loopcheck::compare {
std::string_view page_text() {
    return {kText, sizeof kText - 1};
}
std::string_view why_no_page() {
    return {};
}
}
`;
}

const { values: options, positionals: [output = "page.html"] } = parseArgs({
    allowPositionals: true,
    options: { source: { type: "boolean" }, depfile: { type: "string" } },
});
const fill = { style: await bundled("src/style.css"), script: await bundled("src/main.tsx") };
const template = await readFile(here("src/page.html"), "utf8");
const page = template.replace(/<!--(style|script)-->/g, (_, part) =>
    part === "style" ? `<style>\n${fill.style}</style>` : `<script type="module">\n${fill.script}</script>`);
await writeFile(output, options.source ? source(page) : page);
if (options.depfile !== undefined) {
    const escaped = (/** @type {string} */ path) => path.replaceAll(/[ #]/g, "\\$&").replaceAll("$", "$$$$");
    const paths = [here("src/page.html"), ...inputs].map(escaped);
    await writeFile(options.depfile, `${escaped(output)}: ${paths.join(" ")}\n`);
}

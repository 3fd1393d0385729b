// node build.mjs OUTPUT [--literal]: bundles the page into one HTML file without anything from outside, or, with
// --literal, the same as C++ string literals for #include.
import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = (/** @type {string} */ path) => fileURLToPath(new URL(path, import.meta.url));

async function bundled(/** @type {string} */ entry) {
    const result = await build({
        entryPoints: [here(entry)],
        bundle: true,
        minify: true,
        write: false,
        format: "esm",
        target: "es2022",
        jsx: "automatic",
        jsxImportSource: "preact",
        legalComments: "inline",
        logLevel: "warning",
    });
    return result.outputFiles[0].text;
}

// Literals of more than 65536 bytes are beyond what compilers must take; adjacent ones are one.
function literal(/** @type {string} */ text) {
    const pieces = [];
    for (let at = 0; at < text.length; at += 16000) pieces.push(`R"~~~~(${text.slice(at, at + 16000)})~~~~"\n`);
    return pieces.join("");
}

const [output = "page.html", form] = process.argv.slice(2);
const fill = { style: await bundled("src/style.css"), script: await bundled("src/main.tsx") };
const template = await readFile(here("src/page.html"), "utf8");
const page = template.replace(/<!--(style|script)-->/g, (_, part) =>
    part === "style" ? `<style>\n${fill.style}</style>` : `<script type="module">\n${fill.script}</script>`);
await writeFile(output, form === "--literal" ? literal(page) : page);

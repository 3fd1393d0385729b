// Writes report files as compare/report/html does, for inputs that the program would not write.
import { gzipSync } from "node:zlib";

const kArrayTypes = {
    u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i32: Int32Array, f32: Float32Array, f64: Float64Array,
};

/**
 * A chunk as base64: format.ts says how.
 * @param {object} header without `arrays`
 * @param {{ type: keyof typeof kArrayTypes, values: ArrayLike<number> }[]} arrays
 */
export function chunk(header, arrays = []) {
    const infos = arrays.map(({ type, values }) => ({ type, count: values.length }));
    const json = Buffer.from(JSON.stringify({ ...header, arrays: infos }), "utf8");
    const length = Buffer.alloc(4);
    length.writeUInt32LE(json.length);
    return gzipSync(Buffer.concat([length, json, ...arrays.map(planes)])).toString("base64");
}

/** @param {{ type: keyof typeof kArrayTypes, values: ArrayLike<number> }} array */
function planes({ type, values }) {
    const typed = new kArrayTypes[type](values);
    const bytes = new Uint8Array(typed.buffer);
    const size = typed.BYTES_PER_ELEMENT;
    return Buffer.from(Array.from(bytes, (_, i) => bytes[(i % typed.length) * size + Math.floor(i / typed.length)] ?? 0));
}

/**
 * A report file.
 * @param {string} page
 * @param {Record<string, string>} chunks by id
 */
export function report_file(page, chunks) {
    const elements = Object.entries(chunks).map(
        ([id, text]) => `<script type="application/x-loopcheck" id="${id}">${text}</script>\n`);
    return page.replace("<!--chunks-->", () => elements.join(""));
}

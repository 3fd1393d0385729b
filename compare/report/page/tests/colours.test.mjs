import assert from "node:assert/strict";
import { test } from "node:test";

import { import_ts } from "./support.mjs";

const { ClassScale, ErrorScale, colours_of, kIdentical, kNone, kNotCompared, kNotFinite } = await import_ts("src/colours.ts");
const { appearance, distance } = await import_ts("src/vision.ts");

/** @typedef {readonly [number, number, number]} Rgb */
/** @param {Rgb} a @param {Rgb} b */
const apart = (a, b) => distance(appearance(a), appearance(b));
/** @param {{ label: string }[]} ticks */
const labels = (ticks) => ticks.map((tick) => tick.label);

test("ErrorScale ends at whole decades around its values", () => {
    assert.deepEqual(new ErrorScale({ least: 0.02, largest: 300 }, "u M").decades, [-2, 3]);
    assert.deepEqual(new ErrorScale({ least: 0.01, largest: 1000 }, "u M").decades, [-2, 3]);
    assert.deepEqual(ErrorScale.of(Float32Array.of(0.1, 100), "u M").decades, [-1, 2]);
    assert.deepEqual(ErrorScale.of([0, NaN, 3e-17, Infinity, 2, -5], "u M").decades, [-17, 1]);
});

test("ErrorScale grows brighter with the error", () => {
    const scale = new ErrorScale({ least: 1e-3, largest: 1e3 }, "u M");
    let before = -1;
    for (let exponent = -3; exponent <= 3; exponent += 0.25) {
        const lightness = appearance(scale.colour_of(10 ** exponent))[0];
        assert.ok(lightness > before, `10^${exponent}: ${lightness} after ${before}`);
        before = lightness;
    }
});

test("ErrorScale gives its ends to what is outside", () => {
    const scale = new ErrorScale({ least: 1, largest: 100 }, "u M");
    assert.deepEqual(scale.colour_of(1e-300), scale.colour_of(1));
    assert.deepEqual(scale.colour_of(1e300), scale.colour_of(100));
    assert.notDeepEqual(scale.colour_of(1), scale.colour_of(100));
});

test("ErrorScale has one colour for identical, and one for all that is no finite magnitude", () => {
    const scale = new ErrorScale({ least: 1, largest: 100 }, "u M");
    for (const zero of [0, -0]) assert.deepEqual(scale.colour_of(zero), kIdentical);
    for (const wrong of [Infinity, -Infinity, -1]) assert.deepEqual(scale.colour_of(wrong), kNotFinite);
    assert.deepEqual(scale.colour_of(NaN), kNotCompared);
});

test("ErrorScale keeps its own colours away from the ramp, for every eye", () => {
    const scale = new ErrorScale({ least: 1, largest: 100 }, "u M");
    for (const own of [kIdentical, kNotFinite, kNotCompared]) {
        for (let part = 0; part <= 1; part += 1 / 256) {
            const to_ramp = apart(own, scale.ramp(part));
            assert.ok(to_ramp > 0.1, `${own} is ${to_ramp} from ${scale.ramp(part)}`);
        }
    }
    assert.ok(apart(kIdentical, kNotFinite) > 0.15);
    assert.ok(apart(kIdentical, kNotCompared) > 0.1);
});

test("ErrorScale works without values, with one, and with all the same", () => {
    for (const values of [[], [0, 0], [NaN], [-1]]) {
        const scale = ErrorScale.of(values, "u M");
        assert.equal(scale.decades, null);
        assert.deepEqual(scale.ticks(), []);
        assert.deepEqual(scale.colour_of(0), kIdentical);
        assert.deepEqual(scale.colour_of(NaN), kNotCompared);
        assert.equal(scale.colour_of(1).length, 3);
    }
    for (const value of [5e-324, 1e-16, 1, 3, 1.7976931348623157e308]) {
        const scale = ErrorScale.of([value, value], "u M");
        assert.ok(scale.decades[0] < scale.decades[1]);
        assert.ok(labels(scale.ticks()).length >= 2);
        assert.ok(scale.colour_of(value).every(Number.isInteger));
    }
});

test("ErrorScale labels decades, few enough to be read", () => {
    assert.deepEqual(labels(new ErrorScale({ least: 0.001, largest: 100 }, "u M").ticks()),
        ["0.001", "0.01", "0.1", "1", "10", "100"]);
    assert.deepEqual(labels(new ErrorScale({ least: 1e-16, largest: 1e-12 }, "degrees").ticks()),
        ["1e-16", "1e-15", "1e-14", "1e-13", "1e-12"]);
    const wide = new ErrorScale({ least: 5e-324, largest: 1.7e308 }, "u M").ticks();
    assert.ok(wide.length <= 7);
    assert.ok(wide.every((/** @type {{ at: number }} */ { at }) => at >= 0 && at <= 1));
    const [first, , last] = new ErrorScale({ least: 1, largest: 100 }, "u M").ticks();
    assert.deepEqual([first.at, last.at], [0, 1]);
});

test("ClassScale begins with the palette of Okabe and Ito", () => {
    assert.deepEqual(new ClassScale(["interior 6", "interior 5"]).colour_of(0), [0x00, 0x72, 0xb2]);
    assert.deepEqual(new ClassScale(["interior 6", "interior 5"]).colour_of(1), [0xe6, 0x9f, 0x00]);
});

test("ClassScale leaves 'none', and what is no class, neutral", () => {
    const scale = new ClassScale(["none", "warren-weights"]);
    assert.deepEqual(scale.colour_of(0), kNone);
    assert.deepEqual(scale.colour_of(1), [0x00, 0x72, 0xb2]);
    assert.deepEqual(scale.colour_of(2), kNone);
    assert.deepEqual(scale.colour_of(NaN), kNone);
});

test("ClassScale tells many classes apart, for every eye", () => {
    /** @param {number} count */
    const colours = (count) => new ClassScale(Array.from({ length: count }, (_, i) => `class ${i}`))
        .swatches().map((/** @type {{ colour: Rgb }} */ { colour }) => colour);
    /** @param {Rgb[]} all */
    const least = (all) => Math.min(...all.flatMap((a, i) => all.slice(0, i).map((b) => apart(a, b))));
    assert.ok(least([...colours(7), kNone]) > 0.05, `${least([...colours(7), kNone])}`);
    assert.ok(least([...colours(20), kNone]) > 0.03, `${least([...colours(20), kNone])}`);
    const many = colours(300);
    assert.equal(new Set(many.map(String)).size, 300);
    assert.deepEqual(many.slice(0, 20), colours(20));
    assert.equal(colours(2000).length, 2000);
});

test("colours_of writes three bytes a value", () => {
    const scale = new ErrorScale({ least: 1, largest: 100 }, "u M");
    const rgb = colours_of(scale, Float32Array.of(0, 7, NaN));
    assert.deepEqual([...rgb], [...kIdentical, ...scale.colour_of(7), ...kNotCompared]);
});

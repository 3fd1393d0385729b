// Numbers as text, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";

import { import_ts } from "./support.mjs";

const { counted, grouped, hexfloat, short } = await import_ts("src/numbers.ts");

test("hexfloat is what the JSON report has, for every kind of number", () => {
    assert.deepEqual([1, -0.1, 1 / 3, 0, -0, 1e-310, -5e-324, 2 ** -1022, Number.MAX_VALUE, NaN, -Infinity].map(hexfloat), [
        "0x1p+0", "-0x1.999999999999ap-4", "0x1.5555555555555p-2", "0x0p+0", "-0x0p+0", "0x0.012688b70e62bp-1022",
        "-0x0.0000000000001p-1022", "0x1p-1022", "0x1.fffffffffffffp+1023", "nan", "-inf",
    ]);
});

test("short keeps three digits and says what is not finite", () => {
    assert.deepEqual([0, 0.04343, 1.434e14, 999.6, 9999, 0.0009994, null, Infinity].map(short), [
        "0", "0.0434", "1.43e+14", "1000", "10000", "9.99e-4", "not finite", "not finite",
    ]);
});

test("counts are grouped and agree with their noun", () => {
    assert.equal(grouped(1234567), "1\u202f234\u202f567");
    assert.equal(counted(1, "vertex", "vertices"), "1 vertex");
    assert.equal(counted(1000, "face"), "1\u202f000 faces");
});

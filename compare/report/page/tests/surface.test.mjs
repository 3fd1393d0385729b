import assert from "node:assert/strict";
import { test } from "node:test";

import { import_ts } from "./support.mjs";

const { edges_of } = await import_ts("src/viewer/edges.ts");
const { faces_with_place, frame_of, loose_vertices, place, place_exaggerated } =
    await import_ts("src/viewer/surface.ts");
const { around, first_hit } = await import_ts("src/viewer/rays.ts");

/** @param {Uint32Array} pairs */
const listed = (pairs) => Array.from({ length: pairs.length / 2 }, (_, i) => `${pairs[2 * i]}-${pairs[2 * i + 1]}`);

test("edges are listed once, and those of one face as the boundary", () => {
    const square = edges_of(Uint32Array.of(0, 1, 2, 2, 1, 3), 4);
    assert.deepEqual(listed(square.all), ["0-1", "0-2", "1-2", "1-3", "2-3"]);
    assert.deepEqual(listed(square.boundary), ["0-1", "0-2", "1-3", "2-3"]);
    const pillow = edges_of(Uint32Array.of(0, 1, 2, 0, 2, 1), 3);
    assert.deepEqual(listed(pillow.all), ["0-1", "0-2", "1-2"]);
    assert.equal(pillow.boundary.length, 0);
    assert.equal(edges_of(new Uint32Array(), 0).all.length, 0);
});

test("the edges of 200 000 faces take less than a second", () => {
    const n = 317;
    const faces = [];
    for (let j = 0; j + 1 < n; ++j) {
        for (let i = 0; i + 1 < n; ++i) {
            const v = n * j + i;
            faces.push(v, v + 1, v + n, v + 1, v + n + 1, v + n);
        }
    }
    const triangles = Uint32Array.from(faces);
    const start = performance.now();
    const { all, boundary } = edges_of(triangles, n * n);
    const time = performance.now() - start;
    assert.equal(all.length / 2, (triangles.length + 4 * (n - 1)) / 2);
    assert.equal(boundary.length / 2, 4 * (n - 1));
    assert.ok(time < 1000, `${time} ms`);
});

test("a frame puts finite positions of any size within 1/2 of the origin", () => {
    for (const [low, high] of [[-1, 1], [-1.79e308, 1.79e308], [1e300, 1.1e300], [0, 5e-324], [-1e-320, 0], [7, 7]]) {
        const positions = Float64Array.of(low, low, low, high, high, high, NaN, 1, 1, 1, Infinity, 1);
        const frame = frame_of(positions);
        assert.ok(frame.centre.every(Number.isFinite) && Number.isFinite(frame.extent) && frame.extent > 0);
        const { points, finite } = place(positions, frame);
        assert.deepEqual([...finite], [1, 1, 0, 0]);
        for (const x of points.subarray(0, 6)) assert.ok(Math.abs(x) <= 1, `${x} of ${low} and ${high}`);
    }
    assert.deepEqual(frame_of(Float64Array.of(NaN, NaN, NaN)), { centre: [0, 0, 0], extent: 1 });
    assert.deepEqual(frame_of(new Float64Array()), { centre: [0, 0, 0], extent: 1 });
});

test("an exaggeration grows the difference, and nothing else", () => {
    const subject = Float64Array.of(0, 0, 0, 1, 1, 1);
    const reference = Float64Array.of(0, 0, 0, 1 + 2 ** -52, 1, 1);
    const frame = frame_of(subject);
    const at = (/** @type {number} */ exaggeration) =>
        [...place_exaggerated(subject, reference, exaggeration, frame).points];
    assert.deepEqual(at(0), [-0.5, -0.5, -0.5, 0.5, 0.5, 0.5]);
    assert.deepEqual(at(2 ** 52), [-0.5, -0.5, -0.5, 1.5, 0.5, 0.5]);
    assert.deepEqual([...place_exaggerated(subject, reference, 1e300, frame).finite], [1, 0]);
});

test("faces at a vertex without a place are left out, and its neighbours are loose", () => {
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, NaN, 1, 0, 2, 2, 0);
    const triangles = Uint32Array.of(0, 1, 2, 1, 3, 4);
    const placed = place(positions, frame_of(positions));
    const faces = faces_with_place(triangles, placed);
    assert.deepEqual([...faces], [0]);
    assert.deepEqual([...loose_vertices(triangles, faces, placed)], [4]);
});

test("a ray meets the nearest face from either side, and names the nearest corner", () => {
    const points = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1);
    const triangles = Uint32Array.of(0, 1, 2, 3, 4, 5);
    const faces = Uint32Array.of(0, 1);
    const hit = (/** @type {number[]} */ origin, /** @type {number[]} */ direction, vertex = -1) =>
        first_hit(triangles, faces, { points }, origin, direction, vertex);
    assert.deepEqual(hit([0.1, 0.1, 3], [0, 0, -1]), { face: 1, distance: 2, corner: 0 });
    assert.equal(hit([0.8, 0.1, -3], [0, 0, 1])?.face, 0);
    assert.equal(hit([0.8, 0.1, -3], [0, 0, 1])?.corner, 1);
    assert.equal(hit([0.1, 0.8, -3], [0, 0, 1])?.corner, 2);
    assert.equal(hit([0.1, 0.1, 3], [0, 0, -1], 4)?.face, 0);
    assert.equal(hit([0.1, 0.1, 3], [0, 0, 1]), null);
    assert.equal(hit([0.8, 0.8, 3], [0, 0, -1]), null);
});

test("the surroundings of a vertex are its normal and its farthest neighbour", () => {
    const points = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 3, 0, 9, 9, 9);
    const triangles = Uint32Array.of(0, 1, 2);
    assert.deepEqual(around(triangles, Uint32Array.of(0), { points }, 0), { normal: [0, 0, 1], radius: 3 });
    assert.deepEqual(around(triangles, Uint32Array.of(0), { points }, 3), { normal: [0, 0, 0], radius: 0 });
});

// A curve page of a small curve, for curve.test.mjs.
import { render } from "preact";

import { Chunk } from "../src/chunk";
import { CurvePage } from "../src/curve";
import type { CaseSummary, CurveCase, CurveJson, VerdictName } from "../src/format";

/// The control points of a quadratic B-spline in the plane, natural ends; its levels are made by corner cutting.
const control = [[0, 0], [1, 2], [3, 2], [4, 0], [6, 0]] as const;

function spatial(points: (readonly [number, number])[], scale: number): Float64Array<ArrayBuffer> {
    return Float64Array.from(points.flatMap(([x, y]) => [x * scale, y * scale, 0]));
}

function between(a: readonly [number, number], b: readonly [number, number], t: number): [number, number] {
    return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
}

function cut(points: readonly (readonly [number, number])[]): [number, number][] {
    return points.slice(1).flatMap((b, i) => [between(points[i]!, b, 1 / 4), between(points[i]!, b, 3 / 4)]);
}

function curve_of(file: string, scale: number, verdict: VerdictName) {
    const level_1 = cut(control);
    const level_2 = cut(level_1);
    const exact = cut(cut(cut(level_2)));
    const nowhere = Float64Array.from(control.flatMap(() => [NaN, NaN, NaN]));
    // As if the first and the last point were outside the domain, and the others an eighth above the curve.
    const on_curve = (points: [number, number][]) => {
        const out = spatial(points.map((p) => [p[0], p[1] - 1 / 8]), scale);
        out.fill(NaN, 0, 3);
        out.fill(NaN, out.length - 3);
        return out;
    };
    const f64 = [spatial([...control], scale), nowhere, spatial(level_1, scale), on_curve(level_1),
        spatial(level_2, scale), on_curve(level_2), spatial(exact, scale)];
    const curve: CurveJson = {
        verdict,
        notes: ["A note with <b>markup</b>."],
        levels: [0, 1, 2].map((level) => ({
            level,
            points: [5, 8, 14][level]!,
            distance: scale * 0.25 ** (level + 1) * (verdict === "differs" && level === 2 ? 10 : 1),
            allowed: scale * 0.25 ** (level + 1),
            error: level * 1e-16,
            bound_use: level * 0.1,
        })),
    };
    const header: CurveCase = {
        kind: "curve",
        file,
        dimension: 2,
        degree: 2,
        ends: "natural",
        drawn: [0, 1],
        levels: [0, 1, 2].map((level) => ({ level, points: 2 * level, on_curve: 2 * level + 1 })),
        left_out: [{ level: 3, points: 26 }],
        exact: 6,
        curve,
        arrays: f64.map((array) => ({ type: "f64", count: array.length })),
    };
    const summary: CaseSummary = {
        model: file,
        boundary: "none",
        creasing: "",
        weights: "",
        vertices: 5,
        faces: 0,
        boundary_edges: 0,
        results: [
            {
                subject: "opensubdiv",
                reference: "ours",
                what: "crease",
                verdict: "within rounding",
                deviations: [],
                largest: 1e-16,
                largest_in_uM: 0.5,
                notes: [],
            },
        ],
    };
    return <CurvePage chunk={new Chunk(header, f64)} summary={summary} />;
}

render(
    <>
        <h2>Curves</h2>
        <section id="curve">{curve_of("<script>.txt", 1, "within rounding")}</section>
        <section id="huge">{curve_of("huge.txt", 1e300, "differs")}</section>
        <section id="one-place">{curve_of("one-place.txt", 0, "identical")}</section>
    </>,
    document.getElementById("page")!,
);

// The page of a curve: its drawing, how far the levels are from it, and what the referee says.
import { useMemo } from "preact/hooks";

import type { Chunk } from "./chunk";
import { CurveDrawing } from "./curve_drawing";
import type { CaseSummary, CurveCase, CurveJson, ResultSummary } from "./format";
import { counted, short } from "./numbers";
import { NumberTable } from "./plots/figure";
import type { Cell } from "./plots/figure";
import { Magnitudes } from "./plots/magnitudes";
import { kVerdicts, Verdict } from "./verdicts";

interface CurvePageProps {
    chunk: Chunk<CurveCase>;
    summary: CaseSummary;
}

export function CurvePage({ chunk, summary }: CurvePageProps) {
    const { curve, degree, ends, dimension, left_out } = chunk.header;
    const points = curve.levels[0]?.points ?? 0;
    return (
        <>
            <p>
                {`${counted(points, "control point")} in `}
                {`${dimension === 2 ? "the plane" : "space"}, degree ${degree}, ${ends} ends. Verdict: `}
                <Verdict of={curve.verdict} />.
            </p>
            <Notes notes={curve.notes} tone={kVerdicts[curve.verdict].tone} />
            <CurveDrawing chunk={chunk} />
            {left_out.map((l) => (
                <p key={l.level}>
                    {`Level ${l.level} (${counted(l.points, "point")}) was checked and is too large for `}
                    this file.
                </p>
            ))}
            <DistancePlot chunk={chunk} />
            <RoundingPlot curve={curve} />
            <Carried results={summary.results} />
        </>
    );
}

function Notes({ notes, tone }: { notes: string[]; tone: string }) {
    if (notes.length === 0) return null;
    return (
        <div class={`notes ${tone}`}>
            <ul>{notes.map((note, i) => <li key={i}>{note}</li>)}</ul>
        </div>
    );
}

/// Differences of this share of the largest coordinate are rounding.
const kRounding = 1e-13;

/// How far the polygons are from the curve, and what is proven of it.
function DistancePlot({ chunk }: { chunk: Chunk<CurveCase> }) {
    const { curve, levels } = chunk.header;
    const made = useMemo(() => {
        const control = levels.find((l) => l.level === 0);
        let largest = 0;
        if (control) for (const x of chunk.array("f64", control.points)) largest = Math.max(largest, Math.abs(x));
        const slack = kRounding * largest;
        const magnitudes = curve.levels.map((l, category) => {
            const value = l.distance ?? Infinity;
            const allowed = l.allowed ?? undefined;
            return {
                category,
                value,
                ...(allowed === undefined ? {} : { bound: allowed, beyond: !(value <= allowed + slack) }),
            };
        });
        return {
            categories: curve.levels.map((l) => String(l.level)),
            series: [{ name: "control polygon of the level", magnitudes }],
            reading: distance_reading(curve, magnitudes.some((m) => m.beyond)),
            bounded: magnitudes.some((m) => m.bound !== undefined),
        };
    }, [chunk]);
    const { bounded, ...rest } = made;
    return (
        <Magnitudes
            title="Distance of each level's polygon from the curve"
            category_label="level"
            magnitude_label="largest |c - P(t)|, model units"
            zero_label="0"
            ordered
            {...(bounded ? { bound_name: "proven bound" } : {})}
            {...rest}
        />
    );
}

function distance_reading({ levels }: CurveJson, beyond: boolean): string {
    const first = levels[0];
    const last = levels.at(-1);
    if (!first || !last) return "No level was compared.";
    const of_level = (l: typeof first) => `${short(l.distance)} at level ${l.level}`;
    const distances = `From ${of_level(first)} to ${of_level(last)}`;
    if (beyond) return `${distances}; there are levels beyond the proven bound.`;
    return levels.some((l) => l.allowed != null)
        ? `${distances}; every level is within the proven bound.`
        : `${distances}; no bound is proven for such knots.`;
}

/// What rounding made of the points.
function RoundingPlot({ curve }: { curve: CurveJson }) {
    const made = useMemo(
        () => ({
            categories: curve.levels.map((l) => String(l.level)),
            series: [
                {
                    name: "ours in double",
                    magnitudes: curve.levels.map((l, category) => ({
                        category,
                        value: l.error ?? Infinity,
                        beyond: !(l.bound_use !== null && l.bound_use <= 1),
                    })),
                },
            ],
            reading: rounding_reading(curve),
            numbers: {
                head: ["level", "points", "largest error, model units", "bound used"],
                rows: curve.levels.map((l) => [
                    String(l.level),
                    String(l.points),
                    short(l.error),
                    short(l.bound_use),
                ]),
            },
        }),
        [curve],
    );
    return (
        <Magnitudes
            title="Rounding error of each level"
            category_label="level"
            magnitude_label="largest |ours - exact|, model units"
            zero_label="exact"
            ordered
            {...made}
        />
    );
}

function rounding_reading({ levels }: CurveJson): string {
    const use = levels.reduce((most, l) => Math.max(most, l.bound_use ?? Infinity), 0);
    if (use === 0) return "No rounding error at all.";
    if (use === Infinity) return "There are points whose error is not finite.";
    return use <= 1
        ? `At most ${short(100 * use)} % of the proven bound is used.`
        : `The error is ${short(use)} times its proven bound.`;
}

/// Subjects that refined a mesh which carries the curve.
function Carried({ results }: { results: ResultSummary[] }) {
    if (results.length === 0) return null;
    const rows = results.map((r): Cell[] => [
        r.subject,
        { text: r.what, style: "name" },
        r.largest_in_uM === null ? "" : short(r.largest_in_uM),
        { text: r.verdict, style: r.verdict === "differs" || r.verdict === "failed" ? "beyond" : "name" },
    ]);
    return (
        <section>
            <h3>The same curve in a mesh</h3>
            <NumberTable head={["subject", "where the curve is", "largest difference, u M", "verdict"]} rows={rows} />
        </section>
    );
}

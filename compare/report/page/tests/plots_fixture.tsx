// Plots of small data whose every mark is known, for plots.test.mjs.
import { render } from "preact";

import type { Case, ClassJson, ComparisonJson } from "../src/format";
import { ConvergencePlot } from "../src/plots/convergence";
import { ErrorPlot } from "../src/plots/error";
import { Histogram } from "../src/plots/histogram";

interface Numbers {
    max: number | null;
    bound: number | null;
    beyond?: number;
    not_finite?: number;
}

function class_of(name: string, numbers: Numbers): ClassJson {
    return { class: name, ...numbers_of(numbers) };
}

function numbers_of({ max, bound, beyond = 0, not_finite = 0 }: Numbers): Omit<ClassJson, "class"> {
    const error = { identical: max === 0 ? 3 : 0, not_finite, max, mean: max, rms: max, max_in_uM: max };
    return {
        vertices: 3,
        difference: error,
        subject_error: error,
        reference_error: error,
        bound_use: max !== null && bound ? max / bound : null,
        beyond_bound: beyond,
        predicted: null,
        largest_bound_in_uM: bound,
    };
}

function comparison_of(): ComparisonJson {
    const levels = [
        [class_of("interior 5", { max: 0, bound: 0 }), class_of("interior 12", { max: 0, bound: 0 })],
        [class_of("interior 5", { max: 1.5, bound: 4 }), class_of("interior 12", { max: 1e13, bound: 8, beyond: 2 })],
        [
            class_of("interior 5", { max: 3, bound: 6 }),
            class_of("interior 12", { max: null, bound: 9, beyond: 3, not_finite: 3 }),
            class_of("<script>", { max: 1e-300, bound: 7 }),
        ],
    ];
    return {
        subject: "ours",
        reference: "<script>alert(1)</script>",
        verdict: "differs",
        notes: [],
        largest_coordinate: 1,
        diagonal: 2,
        uM: 2 ** -53,
        levels: levels.map((classes, level) => ({ level, verdict: "differs", classes, worst: [] })),
        limits: {
            verdict: "within rounding",
            notes: [],
            deviations: [],
            levels: [
                {
                    level: 0,
                    verdict: "within rounding",
                    classes: [{ class: "dart", position: numbers_of({ max: 0.25, bound: 2 }), normal: null }],
                    worst: [],
                },
            ],
        },
    };
}

const convergence: Case["convergence"] = [0, 1, 2, 3].flatMap((level) => [
    { class: "interior 5", level, vertices: 12, distance: 0.5 * 0.4 ** level, factor: 0.4 },
    { class: "crease", level, vertices: 3 * 2 ** level, distance: level === 3 ? 0 : 0.25 ** level, factor: 0.25 },
    { class: "isolated", level, vertices: 1, distance: 0, factor: null },
]);

/// 40 classes: more than can be told apart.
const many: Case["convergence"] = Array.from({ length: 40 }, (_, i) => ({
    class: `interior ${i + 3}`,
    level: 0,
    vertices: 1,
    distance: i + 1,
    factor: null,
}));

const errors = Float32Array.of(0, 0, 0, 0.5, 0.7, 1.5, 2, 2.5, 40, Infinity, NaN);

render(
    <>
        <section id="errors">
            <ErrorPlot comparison={comparison_of()} />
        </section>
        <section id="histogram">
            <Histogram noun={{ one: "vertex", many: "vertices" }} values={errors} title="Errors of ours at level 3" unit="u M" />
        </section>
        <section id="extreme">
            <Histogram noun={{ one: "vertex", many: "vertices" }} values={Float32Array.of(1e-45, 1, 3e38)} title="Extremes" unit="u M" />
        </section>
        <section id="nothing">
            <Histogram noun={{ one: "vertex", many: "vertices" }} values={new Float32Array(100000)} title="Identical" unit="u M" />
            <ConvergencePlot points={[]} />
        </section>
        <section id="convergence">
            <ConvergencePlot points={convergence} />
        </section>
        <section id="many">
            <ConvergencePlot points={many} />
        </section>
    </>,
    document.getElementById("page")!,
);

// How many vertices, or faces, are how far off.
import * as Plot from "@observablehq/plot";
import { useMemo } from "preact/hooks";

import { Figure, PlotCanvas } from "./figure";
import { counted, grouped, power, short } from "../numbers";

const kHeight = 260;
/// Decades a bin: the first with which there are not too many.
const kSteps = [0.5, 1, 2, 5, 10, 20, 50, 100] as const;
const kMostBins = 30;
const kMargin = { marginLeft: 64, marginRight: 12, marginTop: 28, marginBottom: 40 };
/// Pixels of a digit.
const kDigit = 7;

interface Bins {
    identical: number;
    not_finite: number;
    /// Decades.
    step: number;
    /// Bin i holds values from 10^(first + i step) to less than 10^(first + (i + 1) step).
    first: number;
    counts: number[];
    largest: number;
}

export function bins_of(values: Float32Array): Bins {
    let identical = 0;
    let not_finite = 0;
    let least = Infinity;
    let largest = 0;
    for (const value of values) {
        if (value === 0) ++identical;
        else if (!(value > 0 && value < Infinity)) ++not_finite;
        else {
            least = Math.min(least, value);
            largest = Math.max(largest, value);
        }
    }
    if (largest === 0) return { identical, not_finite, step: 0.5, first: 0, counts: [], largest };
    const span = Math.log10(largest) - Math.log10(least);
    const step = kSteps.find((s) => span / s < kMostBins) ?? kSteps[kSteps.length - 1]!;
    const bin = (value: number) => Math.floor(Math.log10(value) / step);
    const first = bin(least);
    const counts = new Array<number>(bin(largest) - first + 1).fill(0);
    for (const value of values) if (value > 0 && value < Infinity) ++counts[bin(value) - first]!;
    return { identical, not_finite, step, first: first * step, counts, largest };
}

interface HistogramProps {
    /// Without NaN: what was not compared is not counted.
    values: Float32Array;
    title: string;
    unit: string;
    /// What has a value.
    noun: { one: string; many: string };
}

export function Histogram({ values, title, unit, noun }: HistogramProps) {
    const bins = useMemo(() => bins_of(values), [values]);
    const bars = useMemo(() => bars_of(bins, unit), [bins, unit]);
    const draw = useMemo(() => (width: number) => options_of(bins, bars, unit, noun.many, width), [bins, bars, unit, noun.many]);
    const reading = reading_of(bins, values.length, unit, noun);
    const rows = bars.map((bar) => [bar.name, String(bar.count)]);
    return (
        <Figure title={title} reading={reading} numbers={{ head: [`error, ${unit}`, noun.many], rows }}>
            <PlotCanvas label={`${title}. ${reading}`} height={kHeight} draw={draw} />
        </Figure>
    );
}

function reading_of({ identical, not_finite, largest }: Bins, all: number, unit: string,
    { one, many }: HistogramProps["noun"]): string {
    if (all === 0) return `There are no ${many}.`;
    const parts = [`${grouped(identical)} of ${counted(all, `${one} is`, `${many} are`)} identical`];
    if (largest > 0) parts.push(`the largest error is ${short(largest)} ${unit}`);
    if (not_finite > 0) parts.push(`${counted(not_finite, "is", "are")} not finite`);
    return `${parts.join("; ")}.`;
}

interface Bar {
    name: string;
    x1: number;
    x2: number;
    count: number;
}

/// In bins: the identical ones apart, below; what is not finite above.
function bars_of({ identical, not_finite, step, first, counts }: Bins, unit: string): Bar[] {
    const edge = (i: number) => short(10 ** (first + i * step));
    const bars = counts.map((count, i) => ({
        name: `${edge(i)} to ${edge(i + 1)} ${unit}`,
        x1: i,
        x2: i + 1,
        count,
    }));
    const end = counts.length;
    return [
        { name: "identical", x1: -2, x2: -1, count: identical },
        ...bars,
        ...(not_finite > 0 ? [{ name: "not finite", x1: end + 1, x2: end + 2, count: not_finite }] : []),
    ];
}

function options_of(bins: Bins, bars: Bar[], unit: string, many: string, width: number): Plot.PlotOptions {
    const { step, first, counts } = bins;
    const apart = [bars[0]!, ...(bins.not_finite > 0 ? [bars.at(-1)!] : [])];
    const centre = (bar: Bar) => (bar.x1 + bar.x2) / 2;
    // Whole decades where there are, else every edge.
    const edges = counts.length === 0 ? [] : [...counts.keys(), counts.length];
    const decades = edges.filter((i) => Number.isInteger(first + i * step));
    const every = Math.ceil(decades.length / 10);
    const most = Math.max(1, ...bars.map((bar) => bar.count));
    const left = -2.5;
    const right = Math.max(counts.length, 1) + (bins.not_finite > 0 ? 2.5 : 0.5);
    const bar_width = (width - kMargin.marginLeft - kMargin.marginRight) / (right - left);
    const counts_fit = kDigit * grouped(most).length < bar_width;
    return {
        ...kMargin,
        x: { domain: [left, right], label: null },
        y: { type: "symlog", domain: [0, most], label: null },
        marks: [
            Plot.gridY(count_ticks(most), { stroke: "var(--line)", strokeOpacity: 1 }),
            Plot.axisY(count_ticks(most), {
                label: many,
                labelArrow: "none",
                tickFormat: grouped,
            }),
            Plot.axisX(decades.filter((_, i) => i % every === 0), {
                tickFormat: (i: number) => power(first + i * step),
                label: `error, ${unit}`,
                labelAnchor: "center",
                labelArrow: "none",
            }),
            Plot.axisX(apart.map(centre), {
                tickFormat: (x: number) => apart.find((bar) => centre(bar) === x)?.name ?? "",
                tickSize: 0,
                label: null,
            }),
            Plot.rect(bars, {
                x1: "x1",
                x2: "x2",
                y1: () => 0,
                y2: "count",
                fill: (bar: Bar) => (bar.name === "not finite" ? "var(--bad)" : "var(--series-0)"),
                insetLeft: 1,
                insetRight: 1,
                title: (bar: Bar) => `${bar.name}: ${bar.count}`,
                className: "bars",
            }),
            Plot.text(counts_fit ? bars.filter((bar) => bar.count > 0) : apart, {
                x: centre,
                y: "count",
                text: (bar: Bar) => grouped(bar.count),
                dy: -7,
            }),
            Plot.ruleY([0]),
        ],
    };
}

/// 0 and powers of ten.
function count_ticks(most: number): number[] {
    const ticks = [0];
    for (let n = 1; n <= most; n *= 10) ticks.push(n);
    return ticks;
}

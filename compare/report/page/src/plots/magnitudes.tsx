// Magnitudes of some series over levels, or over other categories, beside the bounds they must keep.
import * as Plot from "@observablehq/plot";
import { useMemo } from "preact/hooks";

import { Figure, PlotCanvas } from "./figure";
import type { Cell, Numbers } from "./figure";
import { power, short } from "../numbers";
import { has_logarithm, place, places_of } from "./places";
import type { Places } from "./places";
import { kMostCategories, kMostSeries, series_style } from "./theme";

/// One mark: NaN and infinite are "not finite".
export interface Magnitude {
    category: number;
    value: number;
    /// What it must not pass.
    bound?: number;
    beyond?: boolean;
}

export interface Series {
    name: string;
    magnitudes: Magnitude[];
    /// Factor from a category to the next, drawn through the last magnitude.
    factor?: number | undefined;
}

interface MagnitudesProps {
    title: string;
    reading: string;
    /// Of the axes; that of magnitudes with its unit.
    category_label: string;
    magnitude_label: string;
    zero_label: string;
    categories: string[];
    /// Whether categories are an order, so that a line from one to the next means something.
    ordered: boolean;
    series: Series[];
    bound_name?: string;
    numbers?: Numbers;
}

const kHeight = 340;
/// Where labels may be aslant.
const kUnorderedHeight = 390;
/// Shares of a category's width: what its marks take, and one of them at most.
const kSpread = 0.7;
const kMostStep = 0.2;
const kRadius = 4;
/// Labels longer than this, in characters in all, are written aslant.
const kLevelLabels = 60;

/// `categories` and `series` must stay the same objects from one rendering to the next.
export function Magnitudes(props: MagnitudesProps) {
    const shown = useMemo(() => largest_of(props.series, props.categories), [props.series, props.categories]);
    const draw = useMemo(() => (width: number) => options_of(props, shown, width), [props.title, shown]);
    const left_out = [
        rest(shown.series.length, props.series.length, "series"),
        rest(shown.categories.length, props.categories.length, "places"),
    ].filter((text) => text !== "");
    const reading = [props.reading, ...left_out].join(" ");
    return (
        <Figure title={props.title} reading={reading} numbers={props.numbers ?? numbers_of(props)}>
            <PlotCanvas
                label={`${props.title}. ${reading}`}
                height={props.ordered ? kHeight : kUnorderedHeight}
                draw={draw}
            />
            <Legend series={shown.series} bound_name={props.bound_name} />
        </Figure>
    );
}

function rest(shown: number, all: number, what: string): string {
    return shown === all ? "" : `Drawn are the ${shown} ${what} of ${all} with the largest values; the table has all.`;
}

interface Shown {
    series: Series[];
    /// Indices into the categories.
    categories: number[];
}

/// What a reader can still tell apart, in the order given.
function largest_of(series: Series[], categories: string[]): Shown {
    const size = (m: Magnitude) => (m.value < Infinity ? m.value : Infinity);
    const of_series = series.map((s) => s.magnitudes.reduce((most, m) => Math.max(most, size(m)), -1));
    const of_categories = categories.map(() => -1);
    for (const s of series)
        for (const m of s.magnitudes)
            of_categories[m.category] = Math.max(of_categories[m.category] ?? -1, size(m));
    const kept = largest_indices(of_categories, kMostCategories);
    return { series: largest_indices(of_series, kMostSeries).map((i) => series[i]!), categories: kept };
}

function largest_indices(sizes: number[], most: number): number[] {
    const indices = sizes.map((_, i) => i);
    indices.sort((a, b) => (sizes[a]! === sizes[b]! ? a - b : sizes[b]! > sizes[a]! ? 1 : -1));
    return indices.slice(0, most).sort((a, b) => a - b);
}

interface Mark {
    series: string;
    x: number;
    y: number;
    title: string;
    beyond: boolean;
    /// Has a logarithm.
    finite: boolean;
}

function options_of(props: MagnitudesProps, shown: Shown, width: number): Plot.PlotOptions {
    const at_category = new Map(shown.categories.map((category, x) => [category, x]));
    const values = shown.series.flatMap((s) =>
        s.magnitudes.flatMap((m) => (m.bound === undefined ? [m.value] : [m.value, m.bound])));
    const places = places_of(values);
    const step = Math.min(kMostStep, kSpread / shown.series.length);
    const offset = (i: number) => (i - (shown.series.length - 1) / 2) * step;

    const marks: Mark[] = [];
    const bounds: { x1: number; x2: number; y: number; series: string }[] = [];
    const guides: { x1: number; y1: number; x2: number; y2: number; series: string }[] = [];
    shown.series.forEach((s, i) => {
        for (const m of s.magnitudes) {
            const category = at_category.get(m.category);
            if (category === undefined) continue;
            const x = category + offset(i);
            const name = props.categories[m.category]!;
            const bound = m.bound === undefined ? "" : `, bound ${short(m.bound)}`;
            marks.push({
                series: s.name,
                x,
                y: place(places, m.value),
                title: `${s.name}, ${props.category_label} ${name}: ${short(m.value)}${bound}`,
                beyond: m.beyond === true,
                finite: has_logarithm(m.value),
            });
            if (m.bound === undefined) continue;
            bounds.push({ x1: x - 0.45 * step, x2: x + 0.45 * step, y: place(places, m.bound), series: s.name });
        }
        const guide = guide_of(s, offset(i), places);
        if (guide) guides.push({ ...guide, series: s.name });
    });

    const names = shown.series.map((s) => s.name);
    const styles = shown.series.map((_, i) => series_style(i));
    const labels = shown.categories.map((category) => props.categories[category]!);
    const aslant = labels.reduce((sum, label) => sum + label.length + 2, 0) > Math.min(kLevelLabels, width / 8);
    const ends = [-0.5, labels.length - 0.5];
    return {
        marginLeft: 64,
        marginRight: 12,
        marginBottom: aslant ? 88 : 40,
        marginTop: 28,
        x: { domain: ends, label: null },
        y: { domain: places.domain, label: null },
        color: { type: "ordinal", domain: names, range: styles.map((s) => s.colour) },
        symbol: { type: "ordinal", domain: names, range: styles.map((s) => s.symbol) },
        marks: [
            ...place_marks(places, ends, props.zero_label, values),
            Plot.axisX(labels.map((_, i) => i), {
                tickFormat: (i: number) => labels[i] ?? "",
                tickSize: 0,
                label: props.category_label,
                labelAnchor: "center",
                labelArrow: "none",
                ...(aslant ? { tickRotate: -40 } : {}),
            }),
            Plot.axisY(places.decades, {
                tickFormat: power,
                label: props.magnitude_label,
                labelArrow: "none",
            }),
            Plot.link(guides, { x1: "x1", y1: "y1", x2: "x2", y2: "y2", stroke: "series", strokeOpacity: 0.6,
                className: "guides", clip: true }),
            Plot.link(bounds, { x1: "x1", x2: "x2", y: "y", stroke: "series", strokeWidth: 2, strokeDasharray: "3 2",
                className: "bounds" }),
            // No line leads to or from the places apart: it would have no slope.
            Plot.line(props.ordered ? marks : [], { x: "x", y: (m: Mark) => (m.finite ? m.y : NaN), z: "series",
                stroke: "series", strokeOpacity: 0.35, className: "lines" }),
            Plot.dot(marks, { x: "x", y: "y", fill: "series", symbol: "series", r: kRadius, title: "title",
                className: "dots" }),
            Plot.dot(marks.filter((m) => m.beyond), { x: "x", y: "y", r: kRadius + 3, stroke: "var(--bad)",
                strokeWidth: 1.5, className: "beyond" }),
        ],
    };
}

/// The places apart, with their names, where something stands in them.
function place_marks(places: Places, ends: number[], zero_label: string, values: number[]): Plot.Markish[] {
    const [x1, x2] = ends;
    const apart: { y1: number; y2: number; y: number; label: string }[] = [];
    if (values.some((value) => value === 0))
        apart.push({ y1: places.domain[0], y2: places.low - 0.2 * (places.low - places.zero), y: places.zero,
            label: zero_label });
    if (values.some((value) => !(value < Infinity)))
        apart.push({ y1: places.high + 0.2 * (places.not_finite - places.high), y2: places.domain[1],
            y: places.not_finite, label: "not finite" });
    return [
        Plot.gridY(places.decades, { stroke: "var(--line)", strokeOpacity: 1 }),
        Plot.rect(apart, { x1: () => x1, x2: () => x2, y1: "y1", y2: "y2", fill: "var(--raised)" }),
        Plot.axisY(apart.map((p) => p.y), {
            tickFormat: (y: number) => apart.find((p) => p.y === y)?.label ?? "",
            tickSize: 0,
            label: null,
        }),
    ];
}

/// The line of a factor through the last magnitude that has a logarithm.
function guide_of(series: Series, offset: number, places: Places) {
    const { factor } = series;
    if (factor === undefined || !(factor > 0 && factor < Infinity)) return undefined;
    const positive = series.magnitudes.filter((m) => has_logarithm(m.value));
    const first = positive[0];
    const last = positive.at(-1);
    if (!first || !last || first === last) return undefined;
    const y2 = place(places, last.value);
    return {
        x1: first.category + offset,
        y1: y2 - Math.log10(factor) * (last.category - first.category),
        x2: last.category + offset,
        y2,
    };
}

function Legend({ series, bound_name }: { series: Series[]; bound_name?: string | undefined }) {
    return (
        <ul class="plot-legend">
            {series.map((s, i) => (
                <li key={s.name}>
                    <Swatch index={i} />
                    {s.name}
                </li>
            ))}
            {bound_name !== undefined && (
                <li>
                    <svg viewBox="-8 -8 16 16" aria-hidden="true">
                        <path d="M-8 0H8" stroke="currentColor" stroke-width="2" stroke-dasharray="3 2" />
                    </svg>
                    {bound_name}
                </li>
            )}
            {series.some((s) => s.magnitudes.some((m) => m.beyond)) && (
                <li>
                    <svg viewBox="-8 -8 16 16" aria-hidden="true">
                        <circle r="6.5" fill="none" stroke="var(--bad)" stroke-width="1.5" />
                    </svg>
                    beyond its bound
                </li>
            )}
        </ul>
    );
}

/// The symbol of a series, as the plot draws it.
function Swatch({ index }: { index: number }) {
    const { colour, symbol } = series_style(index);
    const path = useMemo(() => symbol_path(symbol), [symbol]);
    return (
        <svg viewBox="-8 -8 16 16" aria-hidden="true">
            <path d={path} fill={colour} />
        </svg>
    );
}

function symbol_path(symbol: string): string {
    const legend = Plot.legend({ symbol: { domain: ["a"], range: [symbol] } });
    return legend.querySelector("path")?.getAttribute("d") ?? "";
}

function numbers_of({ series, categories, category_label, magnitude_label }: MagnitudesProps): Numbers {
    const bounded = series.some((s) => s.magnitudes.some((m) => m.bound !== undefined));
    const rows = series.flatMap((s) =>
        s.magnitudes.map((m): Cell[] => [
            s.name,
            categories[m.category]!,
            m.beyond ? { text: short(m.value), style: "beyond" } : short(m.value),
            ...(bounded ? [m.bound === undefined ? "" : short(m.bound)] : []),
        ]),
    );
    return { head: ["", category_label, magnitude_label, ...(bounded ? ["bound"] : [])], rows };
}

// What a limit page shows beside its model: how far each way of evaluating the surface is off, a face class at a time.
import { useMemo, useState } from "preact/hooks";

import type { SurfaceJson } from "./format";
import { counted, short } from "./numbers";
import { Magnitudes } from "./plots/magnitudes";
import { kVerdicts, Verdict } from "./verdicts";

type FaceClass = SurfaceJson["classes"][number];

interface Column {
    name: string;
    /// What it says, in a sentence.
    what: string;
    /// What it is sorted by: NaN last.
    key: (c: FaceClass) => string | number;
    text: (c: FaceClass) => string;
    beyond?: (c: FaceClass) => boolean;
}

const magnitude = (value: number | null) => value ?? Infinity;
const rate_key = (value: number | null) => value ?? NaN;
const rate_text = (value: number | null) => (value === null ? "" : value.toFixed(4));
const is_beyond = (c: FaceClass) => c.beyond_bound > 0;

const kColumns: Column[] = [
    { name: "face class", what: "Corners of the face.", key: (c) => c.class, text: (c) => c.class },
    { name: "faces", what: "Faces of the class.", key: (c) => c.faces, text: (c) => String(c.faces) },
    { name: "samples", what: "Points that were compared.", key: (c) => c.samples, text: (c) => String(c.samples) },
    {
        name: "position error",
        what: "Largest coordinate of the difference, model units.",
        key: (c) => magnitude(c.position),
        text: (c) => short(c.position),
    },
    {
        name: "bound",
        what: "Largest predicted bound of it, model units.",
        key: (c) => magnitude(c.predicted),
        text: (c) => (c.predicted === 0 ? "rounding" : short(c.predicted)),
    },
    {
        name: "bound used",
        what: "Largest error over its bound.",
        key: (c) => magnitude(c.bound_use),
        text: (c) => (c.bound_use === null ? "not finite" : c.bound_use.toFixed(2)),
        beyond: is_beyond,
    },
    {
        name: "beyond",
        what: "Samples beyond a bound.",
        key: (c) => c.beyond_bound,
        text: (c) => String(c.beyond_bound),
        beyond: is_beyond,
    },
    {
        name: "normal, degrees",
        what: "Largest angle between the normals.",
        key: (c) => magnitude(c.normal_degrees),
        text: (c) => short(c.normal_degrees),
    },
    {
        name: "first",
        what: "First derivatives, relative.",
        key: (c) => magnitude(c.first),
        text: (c) => short(c.first),
    },
    {
        name: "second",
        what: "Second derivatives, relative.",
        key: (c) => magnitude(c.second),
        text: (c) => short(c.second),
    },
    {
        name: "rate",
        what: "What the position error is multiplied by from one level to the next.",
        key: (c) => rate_key(c.rate),
        text: (c) => rate_text(c.rate),
    },
    {
        name: "lambda",
        what: "The largest subdominant eigenvalue of the class, which the rate should come to.",
        key: (c) => rate_key(c.lambda),
        text: (c) => rate_text(c.lambda),
    },
];

interface Order {
    column: number;
    descending: boolean;
}

interface WaysTableProps {
    surfaces: SurfaceJson[];
    /// Index of the way that the view shows, and what happens when another is chosen.
    selected: number;
    on_select: (way: number) => void;
}

/// A table a way, failures first. The button of a column sorts all of them: down, up, and as they came.
export function WaysTable({ surfaces, selected, on_select }: WaysTableProps) {
    const [order, set_order] = useState<Order | undefined>(undefined);
    const ways = useMemo(
        () => surfaces.map((_, i) => i).sort((a, b) => badness(surfaces[a]!) - badness(surfaces[b]!) || a - b),
        [surfaces],
    );
    return (
        <div class="ways">
            {ways.map((way) => (
                <Way
                    key={way}
                    surface={surfaces[way]!}
                    selected={way === selected}
                    on_select={() => on_select(way)}
                    order={order}
                    on_sort={(column) => set_order(next_order(order, column))}
                />
            ))}
        </div>
    );
}

function badness(surface: SurfaceJson): number {
    return kVerdicts[surface.verdict].rank;
}

function next_order(order: Order | undefined, column: number): Order | undefined {
    if (order?.column !== column) return { column, descending: true };
    return order.descending ? { column, descending: false } : undefined;
}

interface WayProps {
    surface: SurfaceJson;
    selected: boolean;
    on_select: () => void;
    order: Order | undefined;
    on_sort: (column: number) => void;
}

function Way({ surface, selected, on_select, order, on_sort }: WayProps) {
    const classes = useMemo(() => sorted(surface.classes, order), [surface, order]);
    return (
        <section class={selected ? "way selected" : "way"} aria-label={surface.method}>
            <h3>{surface.method}</h3>
            <p>
                <Verdict of={surface.verdict} />
                {`, smooth level ${surface.smooth_level}, sharp level ${surface.sharp_level}`}
                {surface.without_surface > 0 &&
                    `; ${counted(surface.without_surface, "face has", "faces have")} no surface`}
                {". "}
                {surface.classes.length > 0 && (
                    <button type="button" aria-pressed={selected} onClick={on_select}>
                        Show on the model
                    </button>
                )}
            </p>
            {surface.notes.length > 0 && (
                <div class={`notes ${kVerdicts[surface.verdict].tone}`}>
                    <ul>{surface.notes.map((note, i) => <li key={i}>{note}</li>)}</ul>
                </div>
            )}
            {classes.length > 0 && (
                <div class="numbers" tabIndex={0} role="group" aria-label={`Face classes by ${surface.method}`}>
                    <table>
                        <thead>
                            <tr>
                                {kColumns.map((column, i) => (
                                    <th key={i} scope="col" class={i === 0 ? "name" : undefined}
                                        aria-sort={sort_of(order, i)}>
                                        <button type="button" class="sort" title={column.what}
                                            onClick={() => on_sort(i)}>
                                            {column.name}
                                        </button>
                                    </th>
                                ))}
                            </tr>
                        </thead>
                        <tbody>
                            {classes.map((c) => (
                                <tr key={c.class}>{kColumns.map((column, i) => cell_of(column, c, i))}</tr>
                            ))}
                        </tbody>
                    </table>
                </div>
            )}
        </section>
    );
}

function cell_of(column: Column, c: FaceClass, i: number) {
    if (i === 0) return <th key={i} scope="row" class="name">{column.text(c)}</th>;
    return <td key={i} class={column.beyond?.(c) ? "beyond" : undefined}>{column.text(c)}</td>;
}

function sort_of(order: Order | undefined, column: number): "ascending" | "descending" | "none" {
    if (order?.column !== column) return "none";
    return order.descending ? "descending" : "ascending";
}

/// Without an order: those with samples beyond a bound first, else as they came.
function sorted(classes: FaceClass[], order: Order | undefined): FaceClass[] {
    if (!order) return [...classes].sort((a, b) => Number(is_beyond(b)) - Number(is_beyond(a)));
    const { key } = kColumns[order.column]!;
    return [...classes].sort((a, b) => compared(key(a), key(b), order.descending));
}

function compared(a: string | number, b: string | number, descending: boolean): number {
    const last = Number(Number.isNaN(a)) - Number(Number.isNaN(b));
    if (last !== 0) return last;
    const up = typeof a === "number" && typeof b === "number"
        ? Number(a > b) - Number(a < b)
        : String(a).localeCompare(String(b), "en", { numeric: true });
    return descending ? -up : up;
}

/// Largest position error by face class and way, beside the bound that is predicted.
export function WaysPlot({ surfaces }: { surfaces: SurfaceJson[] }) {
    const made = useMemo(() => {
        const categories = [...new Set(surfaces.flatMap((s) => s.classes.map((c) => c.class)))];
        const series = surfaces
            .filter((s) => s.classes.length > 0)
            .map((s) => ({
                name: s.method,
                magnitudes: s.classes.map((c) => ({
                    category: categories.indexOf(c.class),
                    value: magnitude(c.position),
                    ...(c.predicted === 0 ? {} : { bound: magnitude(c.predicted) }),
                    beyond: is_beyond(c),
                })),
            }));
        return { categories, series, reading: reading_of(surfaces) };
    }, [surfaces]);
    if (made.series.length === 0) return <p>No way of evaluation was compared.</p>;
    return (
        <Magnitudes
            title="Largest position error by face class and way of evaluation"
            category_label="face class"
            magnitude_label="largest position error, model units"
            zero_label="exact"
            bound_name="predicted bound (none where only rounding is expected)"
            {...made}
            ordered={false}
        />
    );
}

function reading_of(surfaces: SurfaceJson[]): string {
    const all = surfaces.flatMap((s) => s.classes.map((c) => ({ method: s.method, c })));
    const worst = all.reduce((most, one) => (magnitude(one.c.position) > magnitude(most.c.position) ? one : most));
    const size = worst.c.position === null ? "Not finite" : `At most ${short(worst.c.position)} model units`;
    const beyond = all.reduce((sum, { c }) => sum + c.beyond_bound, 0);
    return `${size} (${worst.c.class}, ${worst.method}); ${
        beyond === 0 ? "no sample is beyond its bound" : `${counted(beyond, "sample is", "samples are")} beyond a bound`
    }.`;
}

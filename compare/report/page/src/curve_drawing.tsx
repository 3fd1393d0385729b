// The drawing of a curve: control polygon, levels and the exact curve, to be moved and enlarged.
import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";

import type { Chunk } from "./chunk";
import type { CurveCase } from "./format";
import { short } from "./numbers";
import { series_style } from "./plots/theme";

/// The page, in its own units, which scale with it.
const kWidth = 900;
const kHeight = 560;
const kMargin = 40;
const kLeastZoom = 1e-7;
/// More would show that the exact curve is sampled.
const kMostZoom = 1000;
const kZoomStep = 1.25;
const kPanStep = 40;
/// Levels that are drawn at first: more look like the curve.
const kFirstShown = 3;
const kMostDots = 400;
/// Decades of exaggeration.
const kMostExaggeration = 6;
const kDashes = ["none", "7 3", "2 3", "8 3 2 3"] as const;

/// Points of the page, x and y one after the other; NaN where there is none.
type Flat = Float64Array;

interface Polygon {
    level: number;
    points: Flat;
    /// The curve at each point's parameter.
    on_curve: Flat;
}

interface Geometry {
    polygons: Polygon[];
    exact: Flat;
    closed: boolean;
    /// Model units in one of the page.
    unit: number;
    axes: string;
}

/// Everything on the page, with the control polygon and the curve as large as it takes. Extents of any finite
/// coordinates are finite, since they are taken over the largest.
export function geometry_of(chunk: Chunk<CurveCase>): Geometry {
    const { header } = chunk;
    const [across, up] = header.drawn;
    const all = header.levels.map((l) => ({
        level: l.level,
        points: chunk.array("f64", l.points),
        on_curve: chunk.array("f64", l.on_curve),
    }));
    const exact = chunk.array("f64", header.exact);
    const framed = [exact, ...all.filter((l) => l.level === 0).map((l) => l.points)];
    let largest = 0;
    for (const points of framed)
        for (const x of points) if (Math.abs(x) < Infinity) largest = Math.max(largest, Math.abs(x));
    if (largest === 0) largest = 1;
    const ranges = [across, up].map((axis) => range_of(framed, axis, largest));
    const [x_range, y_range] = [ranges[0]!, ranges[1]!];
    const width = x_range.high - x_range.low;
    const height = y_range.high - y_range.low;
    const fit = Math.min((kWidth - 2 * kMargin) / width, (kHeight - 2 * kMargin) / height);
    const scale = fit > 0 && fit < Infinity ? fit : 1;
    const middle = { x: (x_range.low + x_range.high) / 2, y: (y_range.low + y_range.high) / 2 };
    const flat = (points: Float64Array): Flat => {
        const out = new Float64Array((points.length / 3) * 2);
        for (let i = 0; 3 * i < points.length; ++i) {
            out[2 * i] = kWidth / 2 + (points[3 * i + across]! / largest - middle.x) * scale;
            out[2 * i + 1] = kHeight / 2 - (points[3 * i + up]! / largest - middle.y) * scale;
        }
        return out;
    };
    return {
        polygons: all.map((l) => ({ level: l.level, points: flat(l.points), on_curve: flat(l.on_curve) })),
        exact: flat(exact),
        closed: header.ends === "closed",
        unit: largest / scale,
        axes: `${"xyz"[across]} and ${"xyz"[up]}`,
    };
}

/// Of a coordinate over the largest; 0 where there is none.
function range_of(all: Float64Array[], axis: number, largest: number): { low: number; high: number } {
    let low = Infinity;
    let high = -Infinity;
    for (const points of all)
        for (let i = axis; i < points.length; i += 3) {
            const x = points[i]! / largest;
            if (!(Math.abs(x) <= 1)) continue;
            low = Math.min(low, x);
            high = Math.max(high, x);
        }
    return low <= high ? { low, high } : { low: 0, high: 0 };
}

/// The polygon `factor` times as far from the curve; points outside the domain of the curve have no distance and are
/// left out. The control polygon stays as it is.
export function exaggerated({ level, points, on_curve }: Polygon, factor: number): Flat {
    if (factor === 1 || level === 0) return points;
    return points.map((x, i) => on_curve[i]! + factor * (x - on_curve[i]!));
}

/// A point p of the page stands at zoom p + (x, y).
interface View {
    zoom: number;
    x: number;
    y: number;
}

interface Point {
    x: number;
    y: number;
}

/// Points nearer than this to the one before are not drawn, and if there are still too many, twice as far, and so on: a
/// hundred thousand take a renderer without a graphics card a minute.
const kUnseen = 0.5;
const kMostDrawn = 5000;

/// The path of what is in sight, or nearly.
function path_of(points: Flat, closed: boolean, view: View): string {
    let tolerance = kUnseen;
    let kept = thinned(seen(points, closed, view), tolerance);
    let segments = in_sight(kept);
    while (segments.length > kMostDrawn) {
        tolerance *= 2;
        kept = thinned(kept, tolerance);
        segments = in_sight(kept);
    }
    let end: Point | undefined;
    let path = "";
    for (const [a, b] of segments) {
        if (end?.x !== a.x || end.y !== a.y) path += `M${coordinates(a)}`;
        path += `L${coordinates(b)}`;
        end = b;
    }
    return path;
}

/// The finite points where they are seen; of a closed polygon the first again at the end.
function seen(points: Flat, closed: boolean, view: View): Flat {
    const out = new Float64Array(points.length + 2);
    let count = 0;
    for (let i = 0; i < points.length; i += 2) {
        const x = view.zoom * points[i]! + view.x;
        const y = view.zoom * points[i + 1]! + view.y;
        if (!(Math.abs(x) < Infinity && Math.abs(y) < Infinity)) continue;
        out[count++] = x;
        out[count++] = y;
    }
    if (closed && count > 0) {
        out[count++] = out[0]!;
        out[count++] = out[1]!;
    }
    return out.subarray(0, count);
}

/// Without points that are nearer to the one before; the last stays.
function thinned(points: Flat, tolerance: number): Flat {
    const out = new Float64Array(points.length);
    let count = 0;
    for (let i = 0; i < points.length; i += 2) {
        const [dx, dy] = [points[i]! - out[count - 2]!, points[i + 1]! - out[count - 1]!];
        if (dx * dx + dy * dy < tolerance * tolerance && i < points.length - 2) continue;
        out[count++] = points[i]!;
        out[count++] = points[i + 1]!;
    }
    return out.subarray(0, count);
}

/// Beyond the edges of the page, so that no end is seen.
const kOutside = 100;

/// The parts of the segments between these points that are near the page.
function in_sight(points: Flat): [Point, Point][] {
    const out: [Point, Point][] = [];
    for (let i = 2; i < points.length; i += 2) {
        const a = { x: points[i - 2]!, y: points[i - 1]! };
        const b = { x: points[i]!, y: points[i + 1]! };
        const across = part_between(a.x, b.x, kWidth);
        const up = part_between(a.y, b.y, kHeight);
        const [first, last] = [Math.max(across[0], up[0]), Math.min(across[1], up[1])];
        if (!(first <= last)) continue;
        const at = (t: number) => ({ x: a.x + t * (b.x - a.x), y: a.y + t * (b.y - a.y) });
        out.push([first === 0 ? a : at(first), last === 1 ? b : at(last)]);
    }
    return out;
}

/// The parts of the way from a to b where it is near [0, high]; the first is larger if it never is.
function part_between(a: number, b: number, high: number): [number, number] {
    const [low_at, high_at] = [(-kOutside - a) / (b - a), (high + kOutside - a) / (b - a)];
    if (a === b) return [0, a >= -kOutside && a <= high + kOutside ? 1 : -1];
    return [Math.max(0, Math.min(low_at, high_at)), Math.min(1, Math.max(low_at, high_at))];
}

/// Lines without length, which round caps make dots.
function dots_of(points: Flat, view: View): string {
    const dots = seen(points, false, view);
    let path = "";
    for (let i = 0; i < dots.length; i += 2) {
        const p = { x: dots[i]!, y: dots[i + 1]! };
        if (Math.abs(p.x) < 2 * kWidth && Math.abs(p.y) < 2 * kHeight) path += `M${coordinates(p)}h0`;
    }
    return path;
}

function coordinates({ x, y }: Point): string {
    return `${Math.round(1000 * x) / 1000} ${Math.round(1000 * y) / 1000}`;
}

const kWhole: View = { zoom: 1, x: 0, y: 0 };

function zoomed(view: View, factor: number, at: Point): View {
    const zoom = Math.min(kMostZoom, Math.max(kLeastZoom, view.zoom * factor));
    const ratio = zoom / view.zoom;
    return { zoom, x: at.x + (view.x - at.x) * ratio, y: at.y + (view.y - at.y) * ratio };
}

/// The view of all these points.
function view_of(all: Flat[]): View {
    const low = { x: Infinity, y: Infinity };
    const high = { x: -Infinity, y: -Infinity };
    for (const points of all)
        for (let i = 0; i < points.length; i += 2) {
            const [x, y] = [points[i]!, points[i + 1]!];
            if (!(Math.abs(x) < Infinity && Math.abs(y) < Infinity)) continue;
            low.x = Math.min(low.x, x);
            low.y = Math.min(low.y, y);
            high.x = Math.max(high.x, x);
            high.y = Math.max(high.y, y);
        }
    const fit = Math.min((kWidth - 2 * kMargin) / (high.x - low.x), (kHeight - 2 * kMargin) / (high.y - low.y));
    if (!(fit > 0 && fit < Infinity)) return kWhole;
    const zoom = Math.min(kMostZoom, Math.max(kLeastZoom, fit));
    return {
        zoom,
        x: kWidth / 2 - (zoom * (low.x + high.x)) / 2,
        y: kHeight / 2 - (zoom * (low.y + high.y)) / 2,
    };
}

export function CurveDrawing({ chunk }: { chunk: Chunk<CurveCase> }) {
    const geometry = useMemo(() => geometry_of(chunk), [chunk]);
    const refined = geometry.polygons.filter((p) => p.level > 0).map((p) => p.level);
    const [shown, set_shown] = useState(
        () => new Set<Part>(["control", "exact", ...refined.filter((level) => level <= kFirstShown)]),
    );
    const [decades, set_decades] = useState(0);
    const [view, set_view] = useState(kWhole);
    const factor = 10 ** decades;
    const drawn = useMemo(
        () =>
            geometry.polygons
                .filter((p) => shown.has(part_of(p)))
                .map((p) => ({ level: p.level, points: exaggerated(p, factor) })),
        [geometry, shown, factor],
    );
    const fit = () => {
        const polygons = drawn.map((p) => p.points);
        set_view(view_of(shown.has("exact") ? [...polygons, geometry.exact] : polygons));
    };
    const parts: Part[] = ["control", ...refined, "exact"];
    const names = parts.filter((part) => shown.has(part)).map(name_of);
    const label = `${names.join(", ")}: coordinates ${geometry.axes}`;
    return (
        <div>
            <div class="controls">
                <fieldset class="inline">
                    <legend>Shown</legend>
                    {parts.map((part) => (
                        <label key={part}>
                            <input
                                type="checkbox"
                                checked={shown.has(part)}
                                onChange={() => set_shown(toggled(shown, part))}
                            />
                            <svg viewBox="0 0 32 8" aria-hidden="true">
                                <path d="M0 4H32" {...stroke_of(part)} />
                            </svg>
                            {name_of(part)}
                        </label>
                    ))}
                </fieldset>
                <label>
                    {"Distance of the levels from the curve, exaggerated "}
                    <input
                        type="range"
                        min={0}
                        max={kMostExaggeration}
                        step={0.1}
                        value={decades}
                        aria-valuetext={`${short(factor)} times`}
                        onInput={(event) => set_decades(event.currentTarget.valueAsNumber)}
                    />
                    <output class="factor">{`× ${short(factor)}`}</output>
                </label>
            </div>
            <Pane view={view} set_view={set_view} fit={fit} label={label}>
                {shown.has("exact") && <Line part="exact" points={geometry.exact} closed={false} view={view} />}
                {drawn.map((p) => (
                    <Line key={p.level} part={part_of(p)} points={p.points} closed={geometry.closed} view={view} />
                ))}
                <ScaleBar per_unit={geometry.unit / view.zoom} />
            </Pane>
        </div>
    );
}

/// What can be shown: a number is a level.
type Part = "control" | "exact" | number;

function part_of({ level }: { level: number }): Part {
    return level === 0 ? "control" : level;
}

function name_of(part: Part): string {
    return part === "control" ? "control polygon" : part === "exact" ? "exact curve" : `level ${part}`;
}

function stroke_of(part: Part) {
    if (part === "control") return { stroke: "var(--muted)", "stroke-width": 1.4, "stroke-dasharray": "5 4" };
    if (part === "exact") return { stroke: "var(--ink)", "stroke-width": 2.6, "stroke-dasharray": "none" };
    return {
        stroke: series_style(part - 1).colour,
        "stroke-width": 1.6,
        "stroke-dasharray": kDashes[(part - 1) % kDashes.length]!,
    };
}

function toggled(parts: ReadonlySet<Part>, part: Part): Set<Part> {
    const out = new Set(parts);
    if (!out.delete(part)) out.add(part);
    return out;
}

function Line({ part, points, closed, view }: { part: Part; points: Flat; closed: boolean; view: View }) {
    const path = useMemo(() => path_of(points, closed, view), [points, closed, view]);
    const dots = part !== "exact" && points.length <= 2 * kMostDots ? dots_of(points, view) : "";
    const { stroke } = stroke_of(part);
    return (
        <g data-part={part}>
            <path d={path} {...stroke_of(part)} />
            {dots !== "" && <path class="dots" d={dots} stroke={stroke} stroke-width={part === "control" ? 7 : 5} />}
        </g>
    );
}

/// A length of a round number of model units.
function ScaleBar({ per_unit }: { per_unit: number }) {
    const decade = 10 ** Math.floor(Math.log10(150 * per_unit));
    const length = [5, 2, 1].map((n) => n * decade).find((n) => n <= 150 * per_unit) ?? decade;
    const width = length / per_unit;
    if (!(width > 0 && width < kWidth)) return null;
    return (
        <g class="scale-bar" transform={`translate(14 ${kHeight - 14})`}>
            <path d={`M0 -5V0H${width}V-5`} stroke="var(--ink)" stroke-width="1.2" />
            <text x={width + 8} y={0}>{`${short(length)} in model units`}</text>
        </g>
    );
}

interface PaneProps {
    view: View;
    set_view: (change: (view: View) => View) => void;
    fit: () => void;
    label: string;
    children: ComponentChildren;
}

const kMiddle: Point = { x: kWidth / 2, y: kHeight / 2 };

/// What mouse, touch and keyboard do to the view.
function Pane({ view, set_view, fit, label, children }: PaneProps) {
    const pane = useRef<HTMLDivElement>(null);
    const svg = useRef<SVGSVGElement>(null);
    const pointers = useRef(new Map<number, Point>());

    const on_page = (event: MouseEvent): Point => {
        const box = svg.current!.getBoundingClientRect();
        return {
            x: ((event.clientX - box.left) / box.width) * kWidth,
            y: ((event.clientY - box.top) / box.height) * kHeight,
        };
    };

    // Not as an attribute: those are passive, and could not keep the page from scrolling.
    useEffect(() => {
        const element = pane.current!;
        const on_wheel = (event: WheelEvent) => {
            if (!event.ctrlKey && document.activeElement !== element) return;
            event.preventDefault();
            const at = on_page(event);
            set_view((view) => zoomed(view, event.deltaY < 0 ? kZoomStep : 1 / kZoomStep, at));
        };
        element.addEventListener("wheel", on_wheel, { passive: false });
        return () => element.removeEventListener("wheel", on_wheel);
    }, [set_view]);

    const on_move = (event: PointerEvent) => {
        const before = pointers.current.get(event.pointerId);
        if (!before) return;
        const now = on_page(event);
        pointers.current.set(event.pointerId, now);
        const other = [...pointers.current].find(([id]) => id !== event.pointerId)?.[1];
        set_view((view) =>
            other ? pinched(view, other, before, now) : moved(view, now.x - before.x, now.y - before.y));
    };
    const on_key = (event: KeyboardEvent) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const change = kKeys[event.key];
        if (change) set_view(change);
        else if (event.key === "0" || event.key === "Home") fit();
        else return;
        event.preventDefault();
    };
    const forget = (event: PointerEvent) => pointers.current.delete(event.pointerId);
    return (
        <>
            <div
                ref={pane}
                class="curve-drawing"
                tabIndex={0}
                role="application"
                aria-label="Drawing of the curve: arrow keys move it, plus and minus zoom, 0 shows all of it"
                onKeyDown={on_key}
                onPointerDown={(event) => {
                    event.currentTarget.setPointerCapture(event.pointerId);
                    pointers.current.set(event.pointerId, on_page(event));
                }}
                onPointerMove={on_move}
                onPointerUp={forget}
                onPointerCancel={forget}
            >
                <svg ref={svg} viewBox={`0 0 ${kWidth} ${kHeight}`} role="img" aria-label={label}
                    data-view={`${view.x} ${view.y} ${view.zoom}`}>
                    {children}
                </svg>
            </div>
            <div class="controls">
                <button type="button" onClick={() => set_view((view) => zoomed(view, kZoomStep ** 2, kMiddle))}>
                    Zoom in
                </button>
                <button type="button" onClick={() => set_view((view) => zoomed(view, kZoomStep ** -2, kMiddle))}>
                    Zoom out
                </button>
                <button type="button" onClick={fit}>Show all</button>
                <span class="muted">
                    Drag to move, pinch to zoom; once clicked, also by wheel, arrow keys, + and -.
                </span>
            </div>
        </>
    );
}

function moved(view: View, x: number, y: number): View {
    return { ...view, x: view.x + x, y: view.y + y };
}

/// One finger stays, the other moves.
function pinched(view: View, other: Point, before: Point, now: Point): View {
    const factor = Math.hypot(now.x - other.x, now.y - other.y) / Math.hypot(before.x - other.x, before.y - other.y);
    return factor > 0 && factor < Infinity ? zoomed(view, factor, other) : view;
}

const kKeys: Record<string, ((view: View) => View) | undefined> = {
    ArrowLeft: (view) => moved(view, kPanStep, 0),
    ArrowRight: (view) => moved(view, -kPanStep, 0),
    ArrowUp: (view) => moved(view, 0, kPanStep),
    ArrowDown: (view) => moved(view, 0, -kPanStep),
    "+": (view) => zoomed(view, kZoomStep, kMiddle),
    "=": (view) => zoomed(view, kZoomStep, kMiddle),
    "-": (view) => zoomed(view, 1 / kZoomStep, kMiddle),
};

// The surface of one level in three dimensions, with what it is coloured by and how it is drawn.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";

import { ClassScale, colours_of, ErrorScale } from "./colours";
import type { ComparisonJson } from "./format";
import type { Layer } from "./layers";
import { Legend } from "./legend";
import type { MeshLevel, Points } from "./mesh_level";
import { short } from "./numbers";
import { type Mode, type Surface, Viewer } from "./viewer/viewer";

function modes_of(json: ComparisonJson): { mode: Mode; label: string }[] {
    return [
        { mode: "subject", label: json.subject },
        { mode: "reference", label: json.reference },
        { mode: "overlay", label: "overlay" },
        { mode: "side-by-side", label: "side by side" },
    ];
}

/// Steps of the slider, from the true difference to one of a tenth of the model.
const kExaggerations = 100;
const kMostOfDiagonal = 0.1;

/// How the surface is drawn; it stays when the level changes.
interface Drawing {
    mode: Mode;
    filled: boolean;
    wireframe: boolean;
    shading: boolean;
    /// From 0, the truth, to kExaggerations.
    exaggeration: number;
}

function surface_of(level: MeshLevel, positions: Float64Array): Surface {
    return { positions, triangles: level.triangles, sharp_edges: level.sharp_edges };
}

function largest_finite(values: Float64Array | null): number {
    let out = 0;
    for (const value of values ?? []) if (value > out && value < Infinity) out = value;
    return out;
}

export function SurfaceView({ level, frame, json, points, layers, layer, on_layer, selected, flight, on_pick, name }: {
    level: MeshLevel;
    /// What fills the view at first, so that all levels keep their places.
    frame: Surface | null;
    json: ComparisonJson | undefined;
    points: Points;
    layers: Layer[];
    layer: Layer;
    on_layer: (id: string) => void;
    selected: number | null;
    /// A vertex to fly to; a new object is a new flight.
    flight: { vertex: number } | null;
    on_pick: (vertex: number) => void;
    name: string;
}) {
    const host = useRef<HTMLDivElement>(null);
    const viewer = useRef<Viewer | null>(null);
    const [trouble, set_trouble] = useState<string | null>(null);
    const [drawing, set_drawing] = useState<Drawing>({
        mode: "subject", filled: true, wireframe: false, shading: true, exaggeration: 0,
    });
    const set = (part: Partial<Drawing>) => set_drawing({ ...drawing, ...part });

    const subject = json?.subject ?? "ours";
    const ours = level.positions(subject, points) ?? level.positions("ours", points);
    const theirs = json ? level.positions(json.reference, points) : null;
    const surface = useMemo(() => ours && surface_of(level, ours), [level, ours]);
    const other = useMemo(() => theirs && surface_of(level, theirs), [level, theirs]);
    const scale = useMemo(
        () => (layer.kind === "numbers" ? ErrorScale.of(layer.values, layer.unit) : new ClassScale(layer.names)),
        [layer],
    );
    const colours = useMemo(() => ({ per: layer.per, rgb: colours_of(scale, layer.values) }), [layer, scale]);
    const difference = useMemo(
        () => largest_finite(json ? level.difference(json, points) : null), [level, json, points],
    );
    const most = json && difference > 0 ? Math.max(1, (kMostOfDiagonal * json.diagonal) / difference) : 1;
    const factor = most ** (drawing.exaggeration / kExaggerations);

    useEffect(() => {
        try {
            viewer.current = new Viewer(host.current!);
        } catch (error) {
            set_trouble(error instanceof Error ? error.message : String(error));
        }
        return () => viewer.current?.dispose();
    }, []);
    useEffect(() => {
        if (viewer.current === null) return;
        viewer.current.on_pick = on_pick;
        viewer.current.canvas.setAttribute("aria-label",
            `${name}: drag or use the arrow keys to turn, + and - to zoom, 0 for the whole model, Enter to pick`);
    }, [on_pick, name]);
    useEffect(() => {
        if (surface === null) return;
        const mode = other === null ? "subject" : drawing.mode;
        viewer.current?.show({ ...drawing, ...(frame && { frame }), subject: surface, reference: other, colours, mode, exaggeration: factor, selected });
    }, [surface, other, frame, colours, drawing, factor, selected]);
    useEffect(() => {
        if (flight !== null) viewer.current?.fly_to(flight.vertex);
    }, [flight]);

    return (
        <>
            <div class="controls">
                <label>
                    Colour by{" "}
                    <select value={layer.id} onChange={(event) => on_layer(event.currentTarget.value)}>
                        {layers.map((one) => <option key={one.id} value={one.id}>{one.label}</option>)}
                    </select>
                </label>
                {json !== undefined && other !== null && (
                    <fieldset class="inline">
                        <legend>Show</legend>
                        {modes_of(json).map(({ mode, label }) => (
                            <label key={mode}>
                                <input
                                    type="radio" name="mode" checked={drawing.mode === mode}
                                    onChange={() => set({ mode })}
                                /> {label}
                            </label>
                        ))}
                    </fieldset>
                )}
                <Toggle label="surface" on={drawing.filled} set={(filled) => set({ filled })} />
                <Toggle label="wireframe" on={drawing.wireframe} set={(wireframe) => set({ wireframe })} />
                <Toggle label="shading" on={drawing.shading} set={(shading) => set({ shading })} />
                <button type="button" onClick={() => viewer.current?.reset()}>Whole model</button>
            </div>
            <div class="canvas" ref={host}>
                {trouble !== null && <p role="alert">{trouble} The numbers beside and below need no picture.</p>}
                {other !== null && drawing.mode === "side-by-side" && (
                    <>
                        <span class="side-name first">{subject}</span>
                        <span class="side-name second">{json?.reference}</span>
                    </>
                )}
            </div>
            <Legend scale={scale} title={layer.label} />
            {other !== null && (
                <label class="exaggeration">
                    Exaggerate the difference{" "}
                    <input
                        type="range" min={0} max={kExaggerations} value={drawing.exaggeration} disabled={most === 1}
                        aria-valuetext={`${short(factor)} times`}
                        onInput={(event) => set({ exaggeration: Number(event.currentTarget.value) })}
                    />{" "}
                    <output>{difference === 0 ? "there is none: the positions are equal" : `${short(factor)} times`}</output>
                </label>
            )}
        </>
    );
}

function Toggle({ label, on, set }: { label: string; on: boolean; set: (on: boolean) => void }) {
    return (
        <label>
            <input type="checkbox" checked={on} onChange={(event) => set(event.currentTarget.checked)} /> {label}
        </label>
    );
}

// One case: the verdict in words, the surface, its worst vertices, and one vertex in detail.
import { useEffect, useMemo, useState } from "preact/hooks";

import { type Chunk, read_chunk } from "./chunk";
import type { Case, CaseSummary, CurveCase, Report, ResultSummary } from "./format";
import { CurvePage } from "./curve";
import { face_layers, type Layer, vertex_layers } from "./layers";
import { MeshLevel, type Points } from "./mesh_level";
import { counted, grouped, short } from "./numbers";
import { ConvergencePlot } from "./plots/convergence";
import { ErrorPlot } from "./plots/error";
import { Histogram } from "./plots/histogram";
import { case_link } from "./route";
import { SurfaceView } from "./surface_view";
import { WaysPlot, WaysTable } from "./surface";
import { kVerdicts, Verdict } from "./verdicts";
import { VertexDetails } from "./vertex";
import { WorstVertices } from "./worst";

type Loaded = Chunk<Case> | Chunk<CurveCase>;

/// The chunk with that id; null while it is read, or why it cannot be.
function use_chunk(id: string | undefined): Loaded | Error | null {
    const [loaded, set_loaded] = useState<{ id: string; chunk: Loaded | Error } | null>(null);
    useEffect(() => {
        if (id === undefined) return;
        let wanted = true;
        const keep = (chunk: Loaded | Error) => wanted && set_loaded({ id, chunk });
        read_chunk<Case | CurveCase>(id).then((chunk) => keep(chunk as Loaded), keep);
        return () => {
            wanted = false;
        };
    }, [id]);
    return loaded !== null && loaded.id === id ? loaded.chunk : null;
}

const is_curve = (chunk: Loaded): chunk is Chunk<CurveCase> => chunk.header.kind === "curve";

export function CasePage({ report, case_index, result_index, is_alone }: {
    report: Report;
    case_index: number;
    result_index: number;
    /// The only one of the report: it stands below the table.
    is_alone: boolean;
}) {
    const summary = report.cases[case_index];
    const chunk = use_chunk(summary?.chunk);
    const result = summary?.results[result_index];
    if (summary === undefined || result === undefined)
        return <p role="alert">The report has no result {result_index} of a case {case_index}.</p>;
    return (
        <section class="case" aria-labelledby="case">
            {!is_alone && <p><a href="#/">&larr; All results</a></p>}
            <h2 id="case">{summary.model}</h2>
            <p class="muted">
                {report.command === "curve" ? counted(summary.vertices, "point") : mesh_in_words(summary)}
            </p>
            <ResultChoice summary={summary} case_index={case_index} result_index={result_index} />
            <Notes result={result} />
            {summary.chunk === undefined ? <p>The file has no picture of this case.</p>
                : chunk === null ? <p role="status">Reading &hellip;</p>
                : chunk instanceof Error ? <p role="alert">{chunk.message}</p>
                : is_curve(chunk) ? <CurvePage chunk={chunk} summary={summary} />
                : <MeshPage key={summary.chunk} report={report} chunk={chunk} result={result} summary={summary} />}
        </section>
    );
}

function mesh_in_words(one: CaseSummary): string {
    const weights = one.weights === "loop" ? "" : `, weights ${one.weights}`;
    const boundary = one.boundary_edges === 0 ? "closed" : counted(one.boundary_edges, "boundary edge");
    return `boundary ${one.boundary}, creasing ${one.creasing}${weights}; `
        + `${counted(one.vertices, "vertex", "vertices")}, ${counted(one.faces, "face")}, ${boundary}`;
}

function pair_in_words(result: ResultSummary): string {
    return `${result.subject} against ${result.reference}, ${result.what}`;
}

function ResultChoice({ summary, case_index, result_index }: {
    summary: CaseSummary;
    case_index: number;
    result_index: number;
}) {
    return (
        <nav aria-label="Comparisons of this model">
            <ul class="choice">
                {summary.results.map((result, i) => (
                    <li key={i}>
                        <a href={case_link(case_index, i)} aria-current={i === result_index ? "page" : undefined}
                            class={kVerdicts[result.verdict].tone}>
                            {pair_in_words(result)} <Verdict of={result.verdict} />
                        </a>
                    </li>
                ))}
            </ul>
        </nav>
    );
}

function Notes({ result }: { result: ResultSummary }) {
    return (
        <div class={`notes ${kVerdicts[result.verdict].tone}`}>
            <p>
                <Verdict of={result.verdict} />: {pair_in_words(result)}
                {result.largest_in_uM !== null && `; largest difference ${short(result.largest_in_uM)} u M`}
            </p>
            {result.notes.length > 0 && <ul>{result.notes.map((note, i) => <li key={i}>{note}</li>)}</ul>}
        </div>
    );
}

/// What has the values of a layer; those of faces belong to the control mesh.
const kNouns = {
    vertex: { one: "vertex", many: "vertices" },
    face: { one: "control face", many: "control faces" },
};

function MeshPage({ report, chunk, summary, result }: {
    report: Report;
    chunk: Chunk<Case>;
    summary: CaseSummary;
    result: ResultSummary | undefined;
}) {
    const { header } = chunk;
    const comparison = header.comparisons.findIndex(
        (one) => one.subject === result?.subject && one.reference === result.reference,
    );
    const way = header.surfaces.findIndex((one) => one.method === result?.what);
    const json = header.comparisons[comparison];
    const [level_index, set_level_index] = useState(header.levels.length - 1);
    const [points, set_points] = useState<Points>(result?.what === "limits" ? "limit" : "refined");
    const [selected, set_selected] = useState<number | null>(null);
    const [layer_id, set_layer_id] = useState<string | null>(null);
    const [flight, set_flight] = useState<{ vertex: number } | null>(null);
    useEffect(() => set_points(result?.what === "limits" ? "limit" : "refined"), [result]);

    const level = useMemo(
        () => (header.levels[level_index] ? new MeshLevel(chunk, header.levels[level_index]) : null),
        [chunk, level_index],
    );
    const frame = useMemo(() => {
        const [first] = header.levels;
        if (first === undefined) return null;
        const control = new MeshLevel(chunk, first);
        const positions = control.positions(json?.subject ?? "ours", "refined");
        return positions && { positions, triangles: control.triangles };
    }, [chunk, json]);
    const shown_points: Points = level?.level.limits ? points : "refined";
    const layers = useMemo<Layer[]>(() => {
        if (level === null) return [];
        return [...face_layers(chunk, level, way), ...vertex_layers(chunk, level, comparison, shown_points)];
    }, [chunk, level, way, comparison, shown_points]);
    const layer = layers.find((one) => one.id === layer_id) ?? layers[0];
    const values = useMemo(() => {
        if (layer?.kind !== "numbers") return new Float32Array();
        return Float32Array.from(layer.control ?? layer.values).filter((value) => !Number.isNaN(value));
    }, [layer]);
    const go_to = (vertex: number) => {
        set_selected(vertex);
        set_flight({ vertex });
    };
    return (
        <>
            {level !== null && layer !== undefined && (
                <div class="bench">
                    <div class="view">
                        <LevelControls
                            chunk={chunk} level={level} level_index={level_index} points={shown_points}
                            on_level={(index) => {
                                set_level_index(index);
                                set_selected(null);
                            }}
                            on_points={set_points}
                        />
                        <SurfaceView
                            level={level} frame={frame} json={json} points={shown_points} layers={layers} layer={layer}
                            on_layer={set_layer_id} selected={selected} flight={flight} on_pick={set_selected}
                            name={`${summary.model}, level ${level.level.level}`}
                        />
                    </div>
                    <div class="side">
                        <VertexForm level={level} selected={selected} on_go={go_to} />
                        <WorstVertices level={level} layers={layers} layer={layer} selected={selected} on_go={go_to} />
                        {selected === null ? (
                            <p class="muted">Click a vertex, type its number, or take one of the worst.</p>
                        ) : (
                            <VertexDetails
                                chunk={chunk} level={level} comparison={comparison} points={shown_points}
                                vertex={selected} deviations={report.deviations}
                            />
                        )}
                    </div>
                </div>
            )}
            <LeftOut chunk={chunk} summary={summary} />
            {header.surfaces.length > 0 && (
                <>
                    <WaysTable surfaces={header.surfaces} selected={way} on_select={(i) => {
                        location.hash = case_link(report.cases.indexOf(summary), i);
                    }} />
                    <WaysPlot surfaces={header.surfaces} />
                </>
            )}
            <div class="plots">
                {json !== undefined && <ErrorPlot comparison={json} />}
                {level !== null && layer?.kind === "numbers" && (
                    <Histogram
                        values={values} unit={layer.unit} noun={kNouns[layer.per]}
                        title={layer.per === "face" ? layer.label : `${layer.label}, level ${level.level.level}`}
                    />
                )}
                {header.convergence.length > 0 && <ConvergencePlot points={header.convergence} />}
            </div>
        </>
    );
}

function LevelControls({ chunk, level, level_index, points, on_level, on_points }: {
    chunk: Chunk<Case>;
    level: MeshLevel;
    level_index: number;
    points: Points;
    on_level: (index: number) => void;
    on_points: (points: Points) => void;
}) {
    const { levels } = chunk.header;
    return (
        <div class="controls">
            <label class="level">
                Level <b>{level.level.level}</b>{" "}
                <input
                    type="range" min={0} max={levels.length - 1} value={level_index} disabled={levels.length === 1}
                    aria-valuetext={`level ${level.level.level}`}
                    onInput={(event) => on_level(Number(event.currentTarget.value))}
                />
            </label>
            <span class="muted counts">
                {counted(level.level.vertices, "vertex", "vertices")}, {counted(level.triangles.length / 3, "face")}
            </span>
            {level.level.limits && (
                <fieldset class="inline">
                    <legend>Points</legend>
                    {(["refined", "limit"] as const).map((one) => (
                        <label key={one}>
                            <input type="radio" name="points" checked={points === one} onChange={() => on_points(one)} />
                            {" "}{one}
                        </label>
                    ))}
                </fieldset>
            )}
        </div>
    );
}

function VertexForm({ level, selected, on_go }: {
    level: MeshLevel;
    selected: number | null;
    on_go: (vertex: number) => void;
}) {
    // What was typed holds until another vertex is selected.
    const [typed, set_typed] = useState<{ text: string; beside: number | null } | null>(null);
    const text = typed?.beside === selected ? typed.text : String(selected ?? "");
    const vertex = /^\d+$/.test(text) ? Number(text) : NaN;
    const exists = vertex < level.level.vertices;
    return (
        <form class="go" onSubmit={(event) => {
            event.preventDefault();
            if (exists) on_go(vertex);
        }}>
            <h3><label for="vertex">Vertex</label></h3>
            <input
                id="vertex" inputMode="numeric" autocomplete="off" value={text} aria-invalid={text !== "" && !exists}
                aria-describedby="vertices" onInput={(event) => set_typed({ text: event.currentTarget.value, beside: selected })}
            />
            <span id="vertices" class="muted">
                of level {level.level.level}: 0 to {grouped(level.level.vertices - 1)}
            </span>
            <button type="submit" disabled={!exists}>Go</button>
        </form>
    );
}

function LeftOut({ chunk, summary }: { chunk: Chunk<Case>; summary: CaseSummary }) {
    const { left_out, levels } = chunk.header;
    if (left_out.length === 0) return null;
    const list = left_out.map((one) => `${one.level} (${counted(one.vertices, "vertex", "vertices")})`).join(", ");
    const which = left_out.length > 1 ? `Levels ${list} are` : `Level ${list} is`;
    return (
        <p class="muted left-out">
            {levels.length === 0 ? "No level is" : `${which} not`} in this file: too large for it, but compared all the
            same. <code>--html-vertices</code> sets how many vertices of a level of {summary.model} are shown.
        </p>
    );
}

// Everything that is known of one vertex.
import type { ComponentChildren } from "preact";

import type { Chunk } from "./chunk";
import type { Case, ComparisonJson, DeviationInfo } from "./format";
import { type Ancestor, type MeshLevel, point, type Points, type VertexNumber } from "./mesh_level";
import { hexfloat, short } from "./numbers";

export function ancestor_in_words(ancestor: Ancestor): string {
    if ("vertex" in ancestor) return `vertex point of ${ancestor.vertex}`;
    return `edge point of face ${ancestor.face} edge ${ancestor.edge}`;
}

export function VertexDetails({ chunk, level, comparison, points, vertex, deviations }: {
    chunk: Chunk<Case>;
    level: MeshLevel;
    /// Index of the comparison; its errors are shown.
    comparison: number;
    points: Points;
    vertex: number;
    deviations: DeviationInfo[];
}) {
    const json = chunk.header.comparisons[comparison];
    const ancestor = level.ancestor(vertex);
    const seen = level.deviations(comparison, points)?.[vertex] ?? 0;
    const deviation = seen > 0 ? chunk.header.deviations[seen - 1] : undefined;
    return (
        <div class="vertex" data-vertex={vertex}>
            <dl class="facts">
                <dt>From</dt>
                <dd>{ancestor === null ? "the control mesh" : ancestor_in_words(ancestor)}</dd>
                <dt>Class</dt>
                <dd data-field="class">{level.vertex_class(vertex)}</dd>
                <dt>Rule</dt>
                <dd data-field="rule">{level.rule(vertex) ?? "none: a control vertex"}</dd>
                {json !== undefined && (
                    <Errors level={level} json={json} comparison={comparison} points={points} vertex={vertex} />
                )}
            </dl>
            {deviation !== undefined && (
                <Deviation name={deviation} info={deviations.find((one) => one.name === deviation)} />
            )}
            <Positions level={level} points={points} vertex={vertex} />
            {points === "limit" && <Normals level={level} comparison={comparison} vertex={vertex} />}
            <Mask level={level} vertex={vertex} />
        </div>
    );
}

function Errors({ level, json, comparison, points, vertex }: {
    level: MeshLevel;
    json: ComparisonJson;
    comparison: number;
    points: Points;
    vertex: number;
}) {
    const error = level.difference(json, points)?.[vertex];
    const number = (what: VertexNumber) => level.numbers(comparison, points, what)?.[vertex] ?? NaN;
    return (
        <>
            {error !== undefined && (
                <>
                    <dt>|{json.subject} &minus; {json.reference}|</dt>
                    <dd>
                        <span data-field="error" data-value={error}>
                            {error === 0 ? "0: the same bits or signed zeros" : short(error)}
                        </span>
                        {error > 0 && json.diagonal > 0 && `, ${short(error / json.diagonal)} of the diagonal`}
                        {error > 0 && `, ${short(error / json.uM)} u M`}
                    </dd>
                </>
            )}
            <dt>{json.subject}, against 38 digits</dt>
            <dd>{short(number("subject_error"))} u M</dd>
            <dt>{json.reference}, against 38 digits</dt>
            <dd>{short(number("reference_error"))} u M</dd>
            <dt>Proven bound</dt>
            <dd>{short(number("bound"))} u M for both together, used {short(number("bound_use"))} times</dd>
        </>
    );
}

const kKinds: Record<DeviationInfo["kind"], string> = {
    error: "An error",
    approximation: "An approximation",
    documented: "Documented",
};

function Deviation({ name, info }: { name: string; info: DeviationInfo | undefined }) {
    return (
        <div class="deviation">
            <h4>Known deviation: {name}</h4>
            {info !== undefined && (
                <p>
                    {info.what} {kKinds[info.kind]} of {info.family}, seen in {info.versions};{" "}
                    <code>{info.page}</code> says more.
                </p>
            )}
        </div>
    );
}

function Positions({ level, points, vertex }: { level: MeshLevel; points: Points; vertex: number }) {
    const all = points === "limit" ? (level.level.limits?.positions ?? []) : level.level.positions;
    const exact = level.exact(points);
    return (
        <PointTable caption={points === "limit" ? "Limit positions" : "Positions"}>
            {all.map(({ subject }) => {
                const own = level.own_index(subject, vertex);
                const positions = level.positions(subject, points);
                return positions && (
                    <PointRows key={subject} who={own === vertex ? subject : `${subject}: its vertex ${own}`}
                        p={point(positions, vertex)} />
                );
            })}
            {exact !== null && <PointRows who="exact" p={point(exact, vertex)} />}
        </PointTable>
    );
}

function PointTable({ caption, children }: { caption: string; children: ComponentChildren }) {
    return (
        <table class="points">
            <caption>{caption}</caption>
            <thead>
                <tr><th scope="col" colSpan={2}>of</th><th scope="col">decimal</th><th scope="col">hexadecimal</th></tr>
            </thead>
            {children}
        </table>
    );
}

/// A line a coordinate.
function PointRows({ who, p }: { who: string; p: [number, number, number] }) {
    return (
        <tbody data-who={who}>
            {p.map((x, i) => (
                <tr key={i}>
                    {i === 0 && <th scope="rowgroup" rowSpan={3}>{who}</th>}
                    <th scope="row">{"xyz"[i]}</th>
                    <td>{String(x)}</td>
                    <td><code>{hexfloat(x)}</code></td>
                </tr>
            ))}
        </tbody>
    );
}

function Normals({ level, comparison, vertex }: { level: MeshLevel; comparison: number; vertex: number }) {
    const angle = level.normal_numbers(comparison, "normal")?.[vertex] ?? NaN;
    const bound = level.normal_numbers(comparison, "normal_bound")?.[vertex] ?? NaN;
    const exact = level.exact_normals();
    return (
        <>
            <PointTable caption="Normals">
                {(level.level.limits?.positions ?? []).map(({ subject }) => {
                    const normals = level.normals(subject);
                    return normals && <PointRows key={subject} who={subject} p={point(normals, vertex)} />;
                })}
                {exact !== null && <PointRows who="exact" p={point(exact, vertex)} />}
            </PointTable>
            <p class="muted">
                {Number.isNaN(angle) ? "There is no normal here to compare."
                    : `The normals are ${short(angle)}\u00b0 apart; rounding explains ${short(bound)}\u00b0.`}
            </p>
        </>
    );
}

function Mask({ level, vertex }: { level: MeshLevel; vertex: number }) {
    const mask = level.mask(vertex);
    if (mask.length === 0) return null;
    return (
        <table class="mask">
            <caption>Mask: weights of vertices of level {level.level.level - 1}</caption>
            <thead><tr><th scope="col">vertex</th><th scope="col">weight</th></tr></thead>
            <tbody>
                {mask.map((entry, i) => (
                    <tr key={i}><td>{entry.vertex}</td><td data-field="weight">{entry.weight}</td></tr>
                ))}
            </tbody>
        </table>
    );
}

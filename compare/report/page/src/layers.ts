// What a surface can be coloured by.
import type { Chunk } from "./chunk";
import type { Case } from "./format";
import type { MeshLevel, Points, VertexNumber } from "./mesh_level";

/// Values of one level: numbers on a scale, or indices of names.
export type Layer = NumberLayer | NameLayer;

interface LayerBase {
    id: string;
    label: string;
    per: "vertex" | "face";
}
export interface NumberLayer extends LayerBase {
    kind: "numbers";
    unit: string;
    values: ArrayLike<number>;
    /// Those of faces belong to control faces, from which they were spread.
    control?: ArrayLike<number>;
}
export interface NameLayer extends LayerBase {
    kind: "names";
    names: readonly string[];
    values: ArrayLike<number>;
}

/// What can be shown of a comparison (compare, suite) at a level.
export function vertex_layers(chunk: Chunk<Case>, level: MeshLevel, comparison: number, points: Points): Layer[] {
    const { header } = chunk;
    const json = header.comparisons[comparison];
    const layers: Layer[] = [];
    const add = (id: string, label: string, unit: string, values: ArrayLike<number> | null) => {
        if (values !== null) layers.push({ kind: "numbers", id, label, unit, per: "vertex", values });
    };
    if (json !== undefined) {
        const difference = level.difference(json, points);
        const { subject, reference, uM } = json;
        const numbers = (what: VertexNumber) => level.numbers(comparison, points, what);
        add("difference", `error: ${subject} \u2212 ${reference}`, "u M", difference?.map((e) => e / uM) ?? null);
        add("subject", `error of ${subject} (38 digits)`, "u M", numbers("subject_error"));
        add("reference", `error of ${reference} (38 digits)`, "u M", numbers("reference_error"));
        add("bound_use", "share of the proven bound", "", numbers("bound_use"));
        if (points === "limit")
            add("normal", "angle between the normals", "\u00b0", level.normal_numbers(comparison, "normal"));
        const deviations = level.deviations(comparison, points);
        if (deviations !== null)
            layers.push({
                kind: "names", id: "deviation", label: "known deviation", per: "vertex",
                names: ["none", ...header.deviations], values: deviations,
            });
    }
    layers.push({
        kind: "names", id: "class", label: "vertex class", per: "vertex",
        names: header.classes, values: level.classes(),
    });
    return layers;
}

/// What can be shown of a way of evaluation (limit): numbers of control faces, on the refined faces they became.
export function face_layers(chunk: Chunk<Case>, level: MeshLevel, surface: number): Layer[] {
    const control = chunk.header.levels.find((one) => one.level === 0)?.surfaces?.[surface];
    if (!control) return [];
    const faces = level.triangles.length / 3;
    const children = 4 ** level.level.level;
    const spread = (values: ArrayLike<number>) =>
        Float32Array.from({ length: faces }, (_, f) => values[Math.floor(f / children)] ?? NaN);
    const numbers = (id: "position" | "bound" | "normal", label: string, unit: string): Layer => {
        const values = chunk.array("f32", control[id]);
        return { kind: "numbers", id, label, unit, per: "face", values: spread(values), control: values };
    };
    return [
        numbers("position", "largest error of the position", "u M"),
        numbers("bound", "its predicted bound", "u M"),
        numbers("normal", "largest angle between the normals", "\u00b0"),
        {
            kind: "names", id: "face_class", label: "face class", per: "face", names: chunk.header.face_classes,
            values: spread(chunk.indices(control.face_class)),
        },
    ];
}

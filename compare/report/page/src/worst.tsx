// The vertices or faces with the largest values of what is shown.
import { useMemo } from "preact/hooks";

import type { Layer, NumberLayer } from "./layers";
import type { MeshLevel } from "./mesh_level";
import { short } from "./numbers";

const kListed = 20;

/// Indices of the largest values, largest first; equal ones in order; no zeros and no NaN.
export function largest(values: ArrayLike<number>, count: number): number[] {
    const best: number[] = [];
    for (let i = 0; i < values.length; ++i) {
        const value = values[i]!;
        if (!(value > 0) || (best.length === count && value <= values[best[count - 1]!]!)) continue;
        let at = best.length;
        while (at > 0 && values[best[at - 1]!]! < value) --at;
        best.splice(at, 0, i);
        if (best.length > count) best.pop();
    }
    return best;
}

export function WorstVertices({ level, layers, layer, selected, on_go }: {
    level: MeshLevel;
    layers: Layer[];
    layer: Layer;
    selected: number | null;
    on_go: (vertex: number) => void;
}) {
    // Names have no largest: then the first numbers there are.
    const numbers = [layer, ...layers].find((one): one is NumberLayer => one.kind === "numbers");
    const values = numbers?.control ?? numbers?.values ?? [];
    const worst = useMemo(() => largest(values, kListed), [values]);
    if (numbers === undefined) return null;
    // The first of the faces that a control face became is at its first corner.
    const children = 4 ** level.level.level;
    const vertex_of = (i: number) => (numbers.per === "vertex" ? i : level.triangles[3 * i * children]!);
    const noun = numbers.per === "vertex" ? "vertex" : "control face";
    return (
        <div class="worst">
            <h3>Worst {numbers.per === "vertex" ? "vertices" : "control faces"}</h3>
            <p class="muted">{numbers.label}{numbers.per === "vertex" && `, level ${level.level.level}`}</p>
            {worst.length === 0 ? <p>None: all are exactly 0.</p> : (
                <ol>
                    {worst.map((i) => (
                        <li key={i}>
                            <button
                                type="button" aria-pressed={vertex_of(i) === selected}
                                onClick={() => on_go(vertex_of(i))}
                            >
                                {noun} {i} <span class="muted">{short(values[i]!)} {numbers.unit}</span>
                            </button>
                        </li>
                    ))}
                </ol>
            )}
        </div>
    );
}

// One level of a case, with what the referee says of each vertex.
import type { Chunk } from "./chunk";
import type { ArrayRef, Case, ComparisonJson, Level, VertexNumbers } from "./format";

/// Refinement, or the limits of the same vertices.
export type Points = "refined" | "limit";

/// What the referee says of a vertex.
export type VertexNumber = "subject_error" | "reference_error" | "bound" | "bound_use";

export interface MaskEntry {
    vertex: number;
    weight: string;
}

export type Ancestor = { vertex: number } | { face: number; edge: number };

export class MeshLevel {
    readonly level: Level;
    private readonly chunk: Chunk<Case>;
    private readonly differences = new Map<string, Float64Array>();

    constructor(chunk: Chunk<Case>, level: Level) {
        this.chunk = chunk;
        this.level = level;
    }

    get triangles(): Uint32Array {
        return this.chunk.array("u32", this.level.triangles);
    }

    /// Pairs of vertices.
    get sharp_edges(): Uint32Array {
        return this.chunk.array("u32", this.level.sharp);
    }

    /// Three coordinates a vertex; null where the subject is not in the file.
    positions(subject: string, points: Points): Float64Array | null {
        const all = points === "limit" ? this.level.limits?.positions : this.level.positions;
        const found = all?.find((one) => one.subject === subject);
        return found ? this.f64(found.positions) : null;
    }

    normals(subject: string): Float64Array | null {
        const found = this.level.limits?.positions.find((one) => one.subject === subject);
        return found ? this.f64(found.normals) : null;
    }

    exact(points: Points): Float64Array | null {
        const ref = points === "limit" ? this.level.limits?.exact : this.level.exact;
        return ref === undefined ? null : this.f64(ref);
    }

    exact_normals(): Float64Array | null {
        return this.level.limits ? this.f64(this.level.limits.exact_normals) : null;
    }

    /// The largest coordinate of |subject - reference| a vertex; infinite where one is not finite.
    difference(comparison: ComparisonJson, points: Points): Float64Array | null {
        const key = `${comparison.subject}\n${comparison.reference}\n${points}`;
        let out = this.differences.get(key) ?? null;
        if (out === null) {
            const a = this.positions(comparison.subject, points);
            const b = this.positions(comparison.reference, points);
            if (a === null || b === null) return null;
            out = new Float64Array(this.level.vertices);
            for (let v = 0; v < out.length; ++v) {
                let largest = 0;
                for (let i = 3 * v; i < 3 * v + 3; ++i) {
                    const error = Math.abs(a[i]! - b[i]!);
                    largest = error <= largest ? largest : Number.isNaN(error) ? Infinity : error;
                }
                out[v] = largest;
            }
            this.differences.set(key, out);
        }
        return out;
    }

    /// In u M of that comparison (angles in degrees); null where the file has none.
    numbers(comparison: number, points: Points, what: VertexNumber): Float32Array | null {
        const numbers = this.level.comparisons[comparison];
        const from = points === "limit" ? numbers?.limits : numbers;
        return from ? this.chunk.array("f32", from[what]) : null;
    }

    /// Degrees between the normals, NaN where there is none to compare, or their bound.
    normal_numbers(comparison: number, what: "normal" | "normal_bound"): Float32Array | null {
        const limits = this.level.comparisons[comparison]?.limits;
        return limits ? this.chunk.array("f32", limits[what]) : null;
    }

    /// 0, or 1 + the index of the known deviation that shows.
    deviations(comparison: number, points: Points): Uint8Array | null {
        const numbers: VertexNumbers | null | undefined = this.level.comparisons[comparison];
        const ref = points === "limit" ? numbers?.limits?.deviation : numbers?.deviation;
        return ref === undefined ? null : this.chunk.array("u8", ref);
    }

    classes(): ArrayLike<number> {
        return this.chunk.indices(this.level.classes);
    }

    vertex_class(v: number): string {
        return this.chunk.header.classes[this.classes()[v]!]!;
    }

    /// "vertex point, crease"; null at level 0.
    rule(v: number): string | null {
        if (this.level.rules === undefined) return null;
        return this.chunk.header.rules[this.chunk.indices(this.level.rules)[v]!]!;
    }

    ancestor(v: number): Ancestor | null {
        if (this.level.ancestors === undefined) return null;
        const index = this.chunk.array("i32", this.level.ancestors)[v]!;
        if (index >= 0) return { vertex: index };
        const edge = -1 - index;
        return { face: Math.floor(edge / 3), edge: edge % 3 };
    }

    /// The vertices of the level before that the rule reads, with their weights; empty at level 0.
    mask(v: number): MaskEntry[] {
        const { masks, ring_at, ring } = this.level;
        if (masks === undefined || ring_at === undefined || ring === undefined) return [];
        const weights = this.chunk.header.masks[this.chunk.array("u32", masks)[v]!]!.weights;
        const begin = this.chunk.array("u32", ring_at)[v]!;
        const vertices = this.chunk.array("u32", ring);
        return weights.map((weight, i) => ({ vertex: vertices[begin + i]!, weight }));
    }

    /// The vertex in a subject's own order.
    own_index(subject: string, v: number): number {
        const order = this.level.positions.find((one) => one.subject === subject)?.order;
        return order === undefined ? v : this.chunk.array("u32", order)[v]!;
    }

    private f64(ref: ArrayRef): Float64Array {
        return this.chunk.array("f64", ref);
    }
}

export function point(positions: Float64Array, v: number): [number, number, number] {
    return [positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!];
}

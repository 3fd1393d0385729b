export interface Edges {
    /// Each edge once: pairs of vertices.
    all: Uint32Array;
    /// Those of one face only.
    boundary: Uint32Array;
}

/// For drawing: edges with the same ends are one, and look like one.
export function edges_of(triangles: Uint32Array, vertices: number): Edges {
    const keys = new Float64Array(triangles.length);
    for (let i = 0; i < triangles.length; ++i) {
        const a = triangles[i]!;
        const b = triangles[i % 3 === 2 ? i - 2 : i + 1]!;
        keys[i] = a < b ? a * vertices + b : b * vertices + a;
    }
    keys.sort();
    const all = new Uint32Array(2 * keys.length);
    const boundary = new Uint32Array(2 * keys.length);
    let all_end = 0;
    let boundary_end = 0;
    for (let i = 0; i < keys.length;) {
        const key = keys[i]!;
        const first = i;
        while (i < keys.length && keys[i] === key) ++i;
        const low = Math.floor(key / vertices);
        const high = key % vertices;
        all[all_end++] = low;
        all[all_end++] = high;
        if (i - first > 1) continue;
        boundary[boundary_end++] = low;
        boundary[boundary_end++] = high;
    }
    return { all: all.slice(0, all_end), boundary: boundary.slice(0, boundary_end) };
}

/// The pairs both of whose ends have a place.
export function pairs_with_place(pairs: Uint32Array, finite: Uint8Array): Uint32Array {
    const kept_pairs = new Uint32Array(pairs.length);
    let end = 0;
    for (let i = 0; i + 1 < pairs.length; i += 2) {
        if (!finite[pairs[i]!] || !finite[pairs[i + 1]!]) continue;
        kept_pairs[end++] = pairs[i]!;
        kept_pairs[end++] = pairs[i + 1]!;
    }
    return kept_pairs.subarray(0, end);
}

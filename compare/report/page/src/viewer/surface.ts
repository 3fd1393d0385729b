// Surfaces in model units, and where they are in the view.

export interface Surface {
    /// Three a vertex, model units; anything, also NaN.
    positions: Float64Array;
    /// Three a face.
    triangles: Uint32Array;
    /// Pairs of vertices.
    sharp_edges?: Uint32Array;
}

/// From model units to the view, where the model is of size 1 around the origin.
export interface Frame {
    centre: readonly [number, number, number];
    extent: number;
}

/// The frame of the finite positions: the middle of their box, and its longest side. No position overflows.
export function frame_of(positions: Float64Array): Frame {
    const centre: [number, number, number] = [0, 0, 0];
    let extent = 0;
    for (let axis = 0; axis < 3; ++axis) {
        let least = Infinity;
        let largest = -Infinity;
        for (let i = 0; i < positions.length; i += 3) {
            if (!is_finite_at(positions, i)) continue;
            const x = positions[i + axis]!;
            if (x < least) least = x;
            if (x > largest) largest = x;
        }
        if (!(least <= largest)) continue;
        const side = largest - least;
        centre[axis] = side < Infinity ? least + side / 2 : least / 2 + largest / 2;
        extent = Math.max(extent, Math.min(side, Number.MAX_VALUE));
    }
    return { centre, extent: extent > 0 ? extent : 1 };
}

function is_finite_at(positions: Float64Array, i: number): boolean {
    return Number.isFinite(positions[i]) && Number.isFinite(positions[i + 1]) && Number.isFinite(positions[i + 2]);
}

/// Positions in a frame.
export interface Placed {
    points: Float32Array;
    /// 1 where a vertex has a place.
    finite: Uint8Array;
}

/// In sizes of the model; beyond it a vertex counts as having no place, for a graphics card could not square it.
const kFarthest = 1e9;

function placed(vertices: number, place: (i: number, axis: number) => number): Placed {
    const points = new Float32Array(3 * vertices);
    const finite = new Uint8Array(vertices);
    for (let vertex = 0; vertex < vertices; ++vertex) {
        const i = 3 * vertex;
        const x = place(i, 0);
        const y = place(i + 1, 1);
        const z = place(i + 2, 2);
        if (!(Math.abs(x) < kFarthest && Math.abs(y) < kFarthest && Math.abs(z) < kFarthest)) continue;
        finite[vertex] = 1;
        points[i] = x;
        points[i + 1] = y;
        points[i + 2] = z;
    }
    return { points, finite };
}

export function place(positions: Float64Array, { centre, extent }: Frame): Placed {
    return placed(positions.length / 3, (i, axis) => (positions[i]! - centre[axis]!) / extent);
}

/// Where the reference is shown: subject + exaggeration (reference - subject). The difference is taken in double and
/// in model units, so that one ulp is not lost.
export function place_exaggerated(
    subject: Float64Array, reference: Float64Array, exaggeration: number, { centre, extent }: Frame,
): Placed {
    return placed(subject.length / 3, (i, axis) => (subject[i]! - centre[axis]!) / extent
        + exaggeration * ((reference[i]! - subject[i]!) / extent));
}

/// The faces all of whose corners have a place.
export function faces_with_place(triangles: Uint32Array, { finite }: Placed): Uint32Array {
    const faces = new Uint32Array(triangles.length / 3);
    let count = 0;
    for (let face = 0; face < faces.length; ++face) {
        const i = 3 * face;
        if (finite[triangles[i]!] && finite[triangles[i + 1]!] && finite[triangles[i + 2]!]) faces[count++] = face;
    }
    return faces.subarray(0, count);
}

/// The vertices that have a place and no face among these.
export function loose_vertices(triangles: Uint32Array, faces: Uint32Array, { finite }: Placed): Uint32Array {
    const loose = finite.slice();
    for (const face of faces) {
        for (let i = 3 * face; i < 3 * face + 3; ++i) loose[triangles[i]!] = 0;
    }
    return Uint32Array.from(loose.keys()).filter((vertex) => loose[vertex] === 1);
}

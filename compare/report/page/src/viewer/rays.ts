// Rays against the faces that are drawn, in double.
import type { Placed } from "./surface";

export type Vector = readonly [number, number, number];

export interface Hit {
    face: number;
    /// In lengths of the direction.
    distance: number;
    /// The corner of the face, 0 to 2, whose colour is there: the one of the largest barycentric coordinate.
    corner: number;
}

/// The first face that a ray meets, from either side; none of `vertex`, where one is given.
export function first_hit(
    triangles: Uint32Array, faces: Uint32Array, { points }: Placed, origin: Vector, direction: Vector, vertex = -1,
): Hit | null {
    const [ox, oy, oz] = origin;
    const [dx, dy, dz] = direction;
    let found: Hit | null = null;
    let nearest = Infinity;
    for (const face of faces) {
        const va = triangles[3 * face]!;
        const vb = triangles[3 * face + 1]!;
        const vc = triangles[3 * face + 2]!;
        if (va === vertex || vb === vertex || vc === vertex) continue;
        const a = 3 * va;
        const b = 3 * vb;
        const c = 3 * vc;
        const ax = points[a]!;
        const ay = points[a + 1]!;
        const az = points[a + 2]!;
        const ux = points[b]! - ax;
        const uy = points[b + 1]! - ay;
        const uz = points[b + 2]! - az;
        const vx = points[c]! - ax;
        const vy = points[c + 1]! - ay;
        const vz = points[c + 2]! - az;
        // Moeller and Trumbore: the point is a + s u + t v = origin + distance direction.
        const px = dy * vz - dz * vy;
        const py = dz * vx - dx * vz;
        const pz = dx * vy - dy * vx;
        const determinant = ux * px + uy * py + uz * pz;
        if (determinant === 0) continue;
        const tx = ox - ax;
        const ty = oy - ay;
        const tz = oz - az;
        const s = (tx * px + ty * py + tz * pz) / determinant;
        if (!(s >= 0 && s <= 1)) continue;
        const qx = ty * uz - tz * uy;
        const qy = tz * ux - tx * uz;
        const qz = tx * uy - ty * ux;
        const t = (dx * qx + dy * qy + dz * qz) / determinant;
        if (!(t >= 0 && s + t <= 1)) continue;
        const distance = (vx * qx + vy * qy + vz * qz) / determinant;
        if (!(distance > 0 && distance < nearest)) continue;
        nearest = distance;
        const r = 1 - s - t;
        found = { face, distance, corner: r >= s && r >= t ? 0 : s >= t ? 1 : 2 };
    }
    return found;
}

/// Around a vertex: the direction of its normal, of length 1 or 0, and the distance to its farthest neighbour.
export function around(
    triangles: Uint32Array, faces: Uint32Array, { points }: Placed, vertex: number,
): { normal: Vector; radius: number } {
    const normal = [0, 0, 0];
    let radius = 0;
    const from = (corner: number) => [0, 1, 2].map((axis) => points[3 * corner + axis]! - points[3 * vertex + axis]!);
    for (const face of faces) {
        const i = [0, 1, 2].find((corner) => triangles[3 * face + corner] === vertex);
        if (i === undefined) continue;
        const u = from(triangles[3 * face + (i + 1) % 3]!);
        const v = from(triangles[3 * face + (i + 2) % 3]!);
        normal[0]! += u[1]! * v[2]! - u[2]! * v[1]!;
        normal[1]! += u[2]! * v[0]! - u[0]! * v[2]!;
        normal[2]! += u[0]! * v[1]! - u[1]! * v[0]!;
        radius = Math.max(radius, Math.hypot(...u), Math.hypot(...v));
    }
    const length = Math.hypot(...normal);
    const [x, y, z] = normal.map((part) => length > 0 ? part / length : 0);
    return { normal: [x!, y!, z!], radius };
}

// One surface on the graphics card.
import * as three from "three";

import { pairs_with_place } from "./edges";
import type { Edges } from "./edges";
import { kept } from "./kept";
import { band_material, disc_material, fill_material, line_material, ring_material } from "./shaders";
import { faces_with_place, loose_vertices } from "./surface";
import type { Placed } from "./surface";

/// Bytes r, g, b, three a vertex or three a face.
export interface Colours {
    per: "vertex" | "face";
    rgb: Uint8Array;
}

/// From CSS; shared by the materials, so that setting one changes what is drawn next.
export interface Palette {
    surface: three.Color;
    line: three.Color;
    reference: three.Color;
    boundary: three.Color;
    sharp: three.Color;
}

export interface Contents {
    triangles: Uint32Array;
    placed: Placed;
    edges: Edges;
    sharp: Uint32Array | null;
    colours: Colours | null;
    selected: number | null;
}

/// How the layer shows in one region.
export interface Look {
    fill: boolean;
    /// Lines in the colours of `fill`, or alone, or over what other layers fill.
    wire: boolean;
    over: boolean;
    shading: boolean;
}

interface Device {
    /// Device pixels a CSS pixel.
    ratio: number;
    /// Of the region, device pixels.
    width: number;
    height: number;
}

function packed(rgb: Uint8Array, i: number): number {
    return rgb[3 * i]! | (rgb[3 * i + 1]! << 8) | (rgb[3 * i + 2]! << 16);
}

function packed_colour(colour: three.Color): number {
    return Math.round(255 * colour.r) | (Math.round(255 * colour.g) << 8) | (Math.round(255 * colour.b) << 16);
}

/// Three corners a face, each with the colours of all three.
function fill_geometry(triangles: Uint32Array, faces: Uint32Array, points: Float32Array): three.BufferGeometry {
    const corners = new Float32Array(9 * faces.length);
    let at = 0;
    for (const face of faces) {
        for (let corner = 0; corner < 3; ++corner) {
            const i = 3 * triangles[3 * face + corner]!;
            corners[at++] = points[i]!;
            corners[at++] = points[i + 1]!;
            corners[at++] = points[i + 2]!;
        }
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(corners, 3));
    geometry.setAttribute("corner_colours", new three.BufferAttribute(new Uint32Array(9 * faces.length), 3));
    return geometry;
}

function colour_fill(
    geometry: three.BufferGeometry, triangles: Uint32Array, faces: Uint32Array, colours: Colours | null, plain: number,
): void {
    const attribute = geometry.getAttribute("corner_colours");
    const out = attribute.array;
    if (colours === null) {
        out.fill(plain);
    } else {
        let at = 0;
        const { rgb } = colours;
        const per_face = colours.per === "face";
        for (const face of faces) {
            const a = packed(rgb, per_face ? face : triangles[3 * face]!);
            const b = per_face ? a : packed(rgb, triangles[3 * face + 1]!);
            const c = per_face ? a : packed(rgb, triangles[3 * face + 2]!);
            for (let corner = 0; corner < 3; ++corner) {
                out[at++] = a;
                out[at++] = b;
                out[at++] = c;
            }
        }
    }
    attribute.needsUpdate = true;
}

function line_geometry(pairs: Uint32Array, points: Float32Array): three.BufferGeometry {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(points, 3));
    geometry.setIndex(new three.BufferAttribute(pairs, 1));
    return geometry;
}

const kBandCorners = [0, 1, 2, 0, 2, 3];

/// Four corners a pair: each end twice, with the other end, and the side it is moved to.
function band_geometry(pairs: Uint32Array, points: Float32Array): three.BufferGeometry {
    const count = pairs.length / 2;
    const ends = new Float32Array(12 * count);
    const others = new Float32Array(12 * count);
    const sides = new Float32Array(4 * count);
    const index = new Uint32Array(6 * count);
    for (let pair = 0; pair < count; ++pair) {
        for (let corner = 0; corner < 4; ++corner) {
            const own = pairs[2 * pair + (corner >> 1)]!;
            const other = pairs[2 * pair + 1 - (corner >> 1)]!;
            const at = 4 * pair + corner;
            for (let axis = 0; axis < 3; ++axis) {
                ends[3 * at + axis] = points[3 * own + axis]!;
                others[3 * at + axis] = points[3 * other + axis]!;
            }
            sides[at] = corner % 2 === 0 ? 1 : -1;
        }
        // Seen from the other end, the sides are swapped.
        kBandCorners.forEach((corner, i) => index[6 * pair + i] = 4 * pair + corner);
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(ends, 3));
    geometry.setAttribute("other", new three.BufferAttribute(others, 3));
    geometry.setAttribute("side", new three.BufferAttribute(sides, 1));
    geometry.setIndex(new three.BufferAttribute(index, 1));
    return geometry;
}

function point_geometry(vertices: ArrayLike<number>, points: Float32Array): three.BufferGeometry {
    const places = new Float32Array(3 * vertices.length);
    for (let i = 0; i < vertices.length; ++i) {
        places.set(points.subarray(3 * vertices[i]!, 3 * vertices[i]! + 3), 3 * i);
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(places, 3));
    geometry.setAttribute("own_colour", new three.BufferAttribute(new Uint32Array(vertices.length), 1));
    return geometry;
}

function colour_points(
    geometry: three.BufferGeometry, vertices: Uint32Array, colours: Colours | null, plain: number,
): void {
    const attribute = geometry.getAttribute("own_colour");
    vertices.forEach((vertex, i) => {
        attribute.array[i] = colours?.per === "vertex" ? packed(colours.rgb, vertex) : plain;
    });
    attribute.needsUpdate = true;
}

/// Edges: of more, those behind the surface would be a fog that tells nothing and takes long to draw.
const kMostBehind = 50_000;

/// Gives an object the geometry, and the one before back to the card.
function dress(objects: { geometry: three.BufferGeometry }[], geometry: three.BufferGeometry): void {
    for (const object of objects) {
        if (object.geometry !== geometry) object.geometry.dispose();
        object.geometry = geometry;
    }
}

export class Layer {
    readonly group = new three.Group();
    private contents: Contents | null = null;
    private readonly palette: Palette;
    private readonly fill = new three.Mesh(new three.BufferGeometry(), fill_material());
    private readonly lines: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
    private readonly over: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
    private readonly behind: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
    private readonly boundary: three.Mesh<three.BufferGeometry, three.ShaderMaterial>;
    private readonly sharp: three.Mesh<three.BufferGeometry, three.ShaderMaterial>;
    private readonly discs = new three.Points(new three.BufferGeometry(), disc_material());
    private readonly ring = new three.Points(new three.BufferGeometry(), ring_material(false));
    private readonly faint_ring = new three.Points(new three.BufferGeometry(), ring_material(true));

    private readonly faces_of = kept(faces_with_place);
    private readonly loose_of = kept(loose_vertices);
    private readonly fill_of = kept(fill_geometry);
    private readonly colour_fill = kept(colour_fill);
    private readonly lines_of = kept((pairs: Uint32Array, { points, finite }: Placed) =>
        line_geometry(pairs_with_place(pairs, finite), points));
    private readonly boundary_of = kept((pairs: Uint32Array, { points, finite }: Placed) =>
        band_geometry(pairs_with_place(pairs, finite), points));
    private readonly sharp_of = kept((pairs: Uint32Array | null, { points, finite }: Placed) =>
        band_geometry(pairs_with_place(pairs ?? new Uint32Array(), finite), points));
    private readonly discs_of = kept(point_geometry);
    private readonly colour_discs = kept(colour_points);
    private readonly ring_of = kept((vertex: number | null, { points, finite }: Placed) =>
        point_geometry(vertex !== null && finite[vertex] ? [vertex] : [], points));

    constructor(palette: Palette) {
        this.palette = palette;
        this.lines = new three.LineSegments(new three.BufferGeometry(), line_material(palette.line, false));
        this.over = new three.LineSegments(new three.BufferGeometry(), line_material(palette.reference, false));
        this.behind = new three.LineSegments(new three.BufferGeometry(), line_material(palette.reference, true));
        this.boundary = new three.Mesh(new three.BufferGeometry(), band_material(palette.boundary));
        this.sharp = new three.Mesh(new three.BufferGeometry(), band_material(palette.sharp));
        // In the order of drawing: what is over or behind something needs that something drawn.
        this.objects().forEach((object, order) => {
            object.frustumCulled = false;
            object.renderOrder = order;
            this.group.add(object);
        });
    }

    set(contents: Contents): void {
        this.contents = contents;
    }

    /// The faces that are drawn.
    faces(): Uint32Array {
        return this.contents === null
            ? new Uint32Array() : this.faces_of(this.contents.triangles, this.contents.placed);
    }

    loose(): Uint32Array {
        return this.contents === null
            ? new Uint32Array() : this.loose_of(this.contents.triangles, this.faces(), this.contents.placed);
    }

    /// Makes what this look needs and is not made yet; null hides all.
    show(look: Look | null, device: Device): void {
        this.group.visible = look !== null && this.contents !== null;
        if (look === null || this.contents === null) return;
        const { triangles, placed, edges, sharp, colours, selected } = this.contents;
        const plain = packed_colour(this.palette.surface);

        this.fill.visible = look.fill;
        if (look.fill) {
            const geometry = this.fill_of(triangles, this.faces(), placed.points);
            this.colour_fill(geometry, triangles, this.faces(), colours, plain);
            dress([this.fill], geometry);
            const { uniforms } = this.fill.material;
            uniforms["shading"]!.value = look.shading;
            uniforms["wire"]!.value = look.wire;
            uniforms["wire_width"]!.value = device.ratio;
        }
        this.lines.visible = look.wire && !look.fill && !look.over;
        this.over.visible = look.over;
        this.behind.visible = look.over && edges.all.length / 2 <= kMostBehind;
        if (this.lines.visible || look.over) {
            dress([this.lines, this.over, this.behind], this.lines_of(edges.all, placed));
        }
        // Without shading and wires a pixel shows a colour that was given, and nothing else.
        const bands = !look.over && (look.shading || look.wire || !look.fill);
        this.boundary.visible = this.sharp.visible = bands;
        if (bands) {
            dress([this.boundary], this.boundary_of(edges.boundary, placed));
            dress([this.sharp], this.sharp_of(sharp, placed));
            for (const { material: { uniforms } } of [this.boundary, this.sharp]) {
                uniforms["width"]!.value = 2 * device.ratio;
                uniforms["size"]!.value.set(device.width, device.height);
            }
        }
        const discs = this.discs_of(this.loose(), placed.points);
        this.colour_discs(discs, this.loose(), colours, plain);
        dress([this.discs], discs);
        dress([this.ring, this.faint_ring], this.ring_of(selected, placed));
        this.discs.material.uniforms["diameter"]!.value = 7 * device.ratio;
        for (const ring of [this.ring, this.faint_ring]) {
            ring.material.uniforms["diameter"]!.value = (look.over ? 14 : 22) * device.ratio;
        }
    }

    dispose(): void {
        for (const object of this.objects()) {
            object.geometry.dispose();
            object.material.dispose();
        }
    }

    private objects() {
        const { fill, discs, boundary, sharp, lines, behind, over, faint_ring, ring } = this;
        return [fill, discs, boundary, sharp, lines, behind, over, faint_ring, ring];
    }
}

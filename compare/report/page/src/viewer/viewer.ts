// Shows a surface, and another beside or over it; says which vertex was picked.
import * as three from "three";

import { edges_of } from "./edges";
import { kept } from "./kept";
import { Layer } from "./layer";
import type { Colours, Look, Palette } from "./layer";
import { Orbit } from "./orbit";
import { around, first_hit } from "./rays";
import type { Vector } from "./rays";
import { frame_of, place, place_exaggerated } from "./surface";
import type { Placed, Surface } from "./surface";

export type { Colours } from "./layer";
export type { Surface } from "./surface";

export type Mode = "subject" | "reference" | "overlay" | "side-by-side";

export interface View {
    subject: Surface;
    /// With the triangles and the order of vertices of the subject.
    reference: Surface | null;
    /// What has size 1 in the view, so that the levels of one model keep their places; the subject where absent.
    frame?: Surface;
    /// null: plain.
    colours: Colours | null;
    /// "overlay" draws the lines of the reference over the subject. Without a reference all show the subject.
    mode: Mode;
    filled: boolean;
    wireframe: boolean;
    /// Without it, and without wireframe, every pixel of a surface has exactly a colour that was given.
    shading: boolean;
    /// The reference is drawn at subject + exaggeration (reference - subject).
    exaggeration: number;
    selected: number | null;
}

/// Where a surface is drawn, CSS pixels within the host.
export interface Region {
    of: "subject" | "reference";
    x: number;
    y: number;
    width: number;
    height: number;
}

/// In CSS pixels: a pointer that moved less was a click, and a vertex without a face that near was meant.
const kClick = 5;
const kNear = 10;
/// Whether a vertex is hidden takes a look at every face: how many of those near a pointer are tried.
const kMostLookedAt = 16;
const kLargestRatio = 2;
/// A vertex without faces is shown as if its neighbours were that far.
const kLooseRadius = 0.05;
/// Tilts of the direction to a vertex, tried in turn where something hides it.
const kTilts: readonly Vector[] =
    [[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

const kPaletteNames = ["surface", "line", "reference", "boundary", "sharp"] as const;

interface Drawn {
    surface: Surface;
    placed: Placed;
    layer: Layer;
}

export class Viewer {
    readonly canvas: HTMLCanvasElement;
    /// Called after a click, a tap or Enter that met a vertex.
    on_pick: (vertex: number) => void = () => {};

    private readonly host: HTMLElement;
    private readonly renderer: three.WebGLRenderer;
    private readonly scene = new three.Scene();
    private readonly orbit: Orbit;
    private readonly palette: Palette;
    private readonly subject: Layer;
    private readonly reference: Layer;
    private readonly resized: ResizeObserver;
    private readonly dark = matchMedia("(prefers-color-scheme: dark)");
    private view: View | null = null;
    private size = { width: 0, height: 0 };
    private frame_request = 0;
    private fitted = false;
    private press: { id: number; x: number; y: number } | null = null;

    private readonly frame_of = kept(frame_of);
    private readonly edges_of = kept(edges_of);
    private readonly place = kept(place);
    private readonly place_exaggerated = kept(place_exaggerated);
    private readonly radius_of = kept(radius_of);

    /// Fills the host, which has a size of its own, with a canvas; the caller names it by aria-label.
    /// Throws an Error, to be read by the user, where the browser has no WebGL 2.
    constructor(host: HTMLElement) {
        this.host = host;
        this.canvas = document.createElement("canvas");
        this.canvas.className = "viewer";
        this.canvas.tabIndex = 0;
        this.canvas.setAttribute("role", "application");
        this.canvas.setAttribute("aria-roledescription", "3D view");
        this.canvas.setAttribute("aria-keyshortcuts",
            "ArrowLeft ArrowRight ArrowUp ArrowDown Shift+ArrowLeft Shift+ArrowRight Shift+ArrowUp Shift+ArrowDown "
            + "Plus - 0 Enter");
        // Kept: a page that is printed shows what was drawn last.
        const wishes = { alpha: true, preserveDrawingBuffer: true };
        // Smooth edges cost a renderer without a graphics card most of its time.
        const context =
            this.canvas.getContext("webgl2", { ...wishes, antialias: true, failIfMajorPerformanceCaveat: true })
            ?? this.canvas.getContext("webgl2", { ...wishes, antialias: false });
        if (context === null) {
            throw new Error("The 3D view needs WebGL 2, which this browser lacks or has switched off.");
        }
        host.append(this.canvas);
        this.renderer = new three.WebGLRenderer({ canvas: this.canvas });
        this.renderer.outputColorSpace = three.LinearSRGBColorSpace;
        this.renderer.autoClear = false;
        this.renderer.setClearColor(0, 0);
        this.renderer.setScissorTest(true);

        this.palette = {
            surface: new three.Color(),
            line: new three.Color(),
            reference: new three.Color(),
            boundary: new three.Color(),
            sharp: new three.Color(),
        };
        this.subject = new Layer(this.palette);
        this.reference = new Layer(this.palette);
        this.scene.add(this.subject.group, this.reference.group);
        this.orbit = new Orbit(this.canvas, this.request_render);
        this.orbit.on_reset = () => this.reset();

        this.canvas.addEventListener("pointerdown", this.pointer_down);
        this.canvas.addEventListener("pointerup", this.pointer_up);
        this.canvas.addEventListener("pointercancel", this.pointer_cancel);
        this.canvas.addEventListener("keydown", this.key);
        this.canvas.addEventListener("webglcontextrestored", this.request_render);
        this.dark.addEventListener("change", this.restyle);
        this.resized = new ResizeObserver(this.resize);
        this.resized.observe(host);
        this.restyle();
        this.resize();
    }

    /// Draws anew what is another object than last time. The eye stays where it is.
    show(view: View): void {
        this.view = view;
        const { subject, reference } = this.drawn(view);
        const edges = this.edges_of(view.subject.triangles, view.subject.positions.length / 3);
        const { colours, selected } = view;
        const sharp = view.subject.sharp_edges ?? null;
        for (const { layer, surface, placed } of reference === null ? [subject] : [subject, reference]) {
            layer.set({ triangles: surface.triangles, placed, edges, sharp, colours, selected });
        }
        if (!this.fitted) this.reset();
        this.request_render();
    }

    /// Puts the vertex in the middle, seen from its normal's side, its neighbours filling a third of the view.
    /// Nothing where it has no place.
    fly_to(vertex: number): void {
        if (this.view === null || this.size.width === 0) return;
        const { surface, placed, layer } = this.main(this.view);
        if (!placed.finite[vertex]) return;
        const faces = layer.faces();
        const { normal, radius } = around(surface.triangles, faces, placed, vertex);
        const target = point_of(placed, vertex);
        this.prepare(this.view);
        const straight = Math.hypot(...normal) > 0 ? normal : this.orbit.direction();
        const distance = this.orbit.distance_for(radius > 0 ? radius : kLooseRadius, 1 / 3);
        const open = kTilts.map((tilt) => unit([0, 1, 2].map((axis) => straight[axis]! + 0.7 * tilt[axis]!), straight))
            .find((direction) => {
                const hit = first_hit(surface.triangles, faces, placed, target, direction, vertex);
                return hit === null || hit.distance > distance;
            });
        this.orbit.fly(target, open ?? straight, distance);
    }

    /// The whole model in view, at once.
    reset(): void {
        if (this.view === null || this.size.width === 0) return;
        this.orbit.fit(this.drawn(this.view).subject.placed.points, this.size.width / this.size.height);
        this.fitted = true;
    }

    /// One, or both of them where they are side by side.
    regions(): Region[] {
        const { width, height } = this.size;
        const view = this.view;
        if (view === null || view.reference === null || view.mode === "subject" || view.mode === "overlay") {
            return [{ of: "subject", x: 0, y: 0, width, height }];
        }
        if (view.mode === "reference") return [{ of: "reference", x: 0, y: 0, width, height }];
        // On whole pixels, whatever the ratio.
        const wide = width >= height;
        const half = Math.floor((wide ? width : height) / 2);
        return wide
            ? [{ of: "subject", x: 0, y: 0, width: half, height },
                { of: "reference", x: width - half, y: 0, width: half, height }]
            : [{ of: "subject", x: 0, y: 0, width, height: half },
                { of: "reference", x: 0, y: height - half, width, height: half }];
    }

    /// Where a vertex is seen, CSS pixels within the host: that of the subject, or where only it is shown, or it is
    /// asked for, of the reference. Not visible: outside, hidden by a face, or without a place.
    pixel_of(vertex: number, of?: Region["of"]): { x: number; y: number; visible: boolean } {
        const regions = this.regions();
        const region = regions.find((candidate) => candidate.of === of) ?? regions[0]!;
        const nowhere = { x: NaN, y: NaN, visible: false };
        if (this.view === null || this.size.width === 0) return nowhere;
        const drawn = this.drawn_in(this.view, of === "reference" ? of : region.of);
        if (!drawn.placed.finite[vertex]) return nowhere;
        this.prepare(this.view);
        const at = this.project(drawn.placed, vertex, region);
        const inside = at.depth > -1 && at.depth < 1 && at.x >= region.x && at.x < region.x + region.width
            && at.y >= region.y && at.y < region.y + region.height;
        return { x: at.x, y: at.y, visible: inside && !(this.view.filled && this.is_hidden(drawn, vertex)) };
    }

    /// Reads the colours of lines from CSS again; happens by itself when the system's colour scheme changes.
    readonly restyle = (): void => {
        const probe = document.createElement("span");
        this.host.append(probe);
        const dot = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
        for (const name of kPaletteNames) {
            if (dot === null) break;
            // Only as a property that computes to a colour are var() and light-dark() resolved.
            probe.style.color = `var(--mesh-${name})`;
            dot.fillStyle = getComputedStyle(probe).color;
            dot.fillRect(0, 0, 1, 1);
            const [r, g, b] = dot.getImageData(0, 0, 1, 1).data;
            this.palette[name].setRGB(r! / 255, g! / 255, b! / 255, three.LinearSRGBColorSpace);
        }
        probe.remove();
        this.request_render();
    };

    dispose(): void {
        cancelAnimationFrame(this.frame_request);
        this.frame_request = 0;
        this.view = null;
        this.resized.disconnect();
        this.dark.removeEventListener("change", this.restyle);
        this.orbit.dispose();
        this.subject.dispose();
        this.reference.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
        this.canvas.remove();
    }

    private drawn(view: View): { subject: Drawn; reference: Drawn | null } {
        const frame = this.frame_of((view.frame ?? view.subject).positions);
        const subject = {
            surface: view.subject,
            placed: this.place(view.subject.positions, frame),
            layer: this.subject,
        };
        if (view.reference === null || view.mode === "subject") return { subject, reference: null };
        const placed =
            this.place_exaggerated(view.subject.positions, view.reference.positions, view.exaggeration, frame);
        return { subject, reference: { surface: view.reference, placed, layer: this.reference } };
    }

    private drawn_in(view: View, of: Region["of"]): Drawn {
        const { subject, reference } = this.drawn(view);
        return of === "reference" && reference !== null ? reference : subject;
    }

    /// Of the first region.
    private main(view: View): Drawn {
        return this.drawn_in(view, this.regions()[0]!.of);
    }

    private readonly request_render = (): void => {
        if (this.frame_request === 0) this.frame_request = requestAnimationFrame(this.render);
    };

    private prepare(view: View): void {
        // Half a view shows what a whole one does, smaller.
        const { width, height } = this.regions()[0]!;
        const whole = this.size.width / this.size.height;
        this.orbit.set_lens(width / height, Math.max(1, whole / (width / height)));
        const { subject, reference } = this.drawn(view);
        this.orbit.prepare(Math.max(this.radius_of(subject.placed), reference === null ? 0 : kReferenceRadius));
    }

    private readonly render = (): void => {
        this.frame_request = 0;
        const { view, size: { width, height } } = this;
        if (view === null || width === 0) return;
        if (!this.fitted) this.reset();
        this.prepare(view);
        const ratio = this.renderer.getPixelRatio();
        this.renderer.setScissor(0, 0, width, height);
        this.renderer.clear();
        for (const region of this.regions()) {
            const look: Look = { fill: view.filled, wire: view.wireframe, over: false, shading: view.shading };
            const over = view.mode === "overlay" && view.reference !== null;
            const device = { ratio, width: ratio * region.width, height: ratio * region.height };
            this.subject.show(region.of === "subject" ? look : null, device);
            this.reference.show(region.of === "reference" ? look
                : over ? { ...look, fill: false, over: true } : null, device);
            // three counts rows from below.
            const below = height - region.y - region.height;
            this.renderer.setViewport(region.x, below, region.width, region.height);
            this.renderer.setScissor(region.x, below, region.width, region.height);
            this.renderer.render(this.scene, this.orbit.camera);
        }
    };

    private readonly resize = (): void => {
        const { clientWidth: width, clientHeight: height } = this.host;
        const ratio = Math.min(kLargestRatio, devicePixelRatio);
        if (width === this.size.width && height === this.size.height && ratio === this.renderer.getPixelRatio()) return;
        // Hidden: nothing to see, and nothing to be near to.
        this.size = width > 0 && height > 0 ? { width, height } : { width: 0, height: 0 };
        if (this.size.width === 0) return;
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height, false);
        // At once: a canvas of another size is empty until it is drawn.
        this.render();
    };

    private project({ points }: Placed, vertex: number, region: Region): { x: number; y: number; depth: number } {
        const { x, y, z } = new three.Vector3().fromArray(points, 3 * vertex).project(this.orbit.camera);
        return {
            x: region.x + (x + 1) / 2 * region.width,
            y: region.y + (1 - y) / 2 * region.height,
            depth: z,
        };
    }

    private is_hidden({ surface, placed, layer }: Drawn, vertex: number): boolean {
        const eye = this.orbit.camera.position.toArray();
        const to = point_of(placed, vertex).map((x, axis) => x - eye[axis]!);
        const hit = first_hit(surface.triangles, layer.faces(), placed, eye, [to[0]!, to[1]!, to[2]!], vertex);
        return hit !== null && hit.distance < 1 - 1e-5;
    }

    /// The corner of the face there that owns the colour there; else the nearest vertex that can be seen, if it is
    /// within `reach` pixels. One without faces is a small thing, and comes first.
    private pick(x: number, y: number, reach: number): number | null {
        const region = this.regions().find((r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height);
        if (this.view === null || region === undefined) return null;
        this.prepare(this.view);
        const drawn = this.drawn_in(this.view, region.of);
        const loose = this.nearest(drawn, drawn.layer.loose(), region, x, y, kNear);
        if (loose !== null) return loose;
        const { camera } = this.orbit;
        const to = new three.Vector3(
            2 * (x - region.x) / region.width - 1, 1 - 2 * (y - region.y) / region.height, 0.5)
            .unproject(camera).sub(camera.position);
        const { surface, placed, layer } = drawn;
        const hit = first_hit(surface.triangles, layer.faces(), placed, camera.position.toArray(), to.toArray());
        if (hit !== null) return surface.triangles[3 * hit.face + hit.corner] ?? null;
        return this.nearest(drawn, placed.finite.keys(), region, x, y, reach);
    }

    private nearest(
        drawn: Drawn, vertices: Iterable<number>, region: Region, x: number, y: number, reach: number,
    ): number | null {
        const candidates: { vertex: number; away: number }[] = [];
        for (const vertex of vertices) {
            if (!drawn.placed.finite[vertex]) continue;
            const at = this.project(drawn.placed, vertex, region);
            const away = Math.hypot(at.x - x, at.y - y);
            if (at.depth > -1 && at.depth < 1 && away < reach) candidates.push({ vertex, away });
        }
        return candidates.sort((a, b) => a.away - b.away).slice(0, kMostLookedAt)
            .find(({ vertex }) => !this.is_hidden(drawn, vertex))?.vertex ?? null;
    }

    private announce(vertex: number | null): void {
        if (vertex !== null) this.on_pick(vertex);
    }

    private readonly pointer_down = (event: PointerEvent): void => {
        // A second finger makes it a gesture.
        this.press = event.isPrimary && event.button === 0
            ? { id: event.pointerId, x: event.offsetX, y: event.offsetY } : null;
    };

    private readonly pointer_up = (event: PointerEvent): void => {
        const { press } = this;
        this.press = null;
        if (press === null || press.id !== event.pointerId) return;
        if (Math.hypot(event.offsetX - press.x, event.offsetY - press.y) >= kClick) return;
        this.announce(this.pick(event.offsetX, event.offsetY, kNear));
    };

    private readonly pointer_cancel = (): void => {
        this.press = null;
    };

    private readonly key = (event: KeyboardEvent): void => {
        if (event.key !== "Enter") return;
        event.preventDefault();
        const { x, y, width, height } = this.regions()[0]!;
        this.announce(this.pick(x + width / 2, y + height / 2, Infinity));
    };
}

/// What of an exaggerated reference is drawn, in sizes of the model around it.
const kReferenceRadius = 10;

function point_of({ points }: Placed, vertex: number): Vector {
    return [points[3 * vertex]!, points[3 * vertex + 1]!, points[3 * vertex + 2]!];
}

function unit(vector: readonly number[], otherwise: Vector): Vector {
    const length = Math.hypot(...vector);
    return length > 0 ? [vector[0]! / length, vector[1]! / length, vector[2]! / length] : otherwise;
}

/// Of the ball around the origin that holds every vertex; not 0, for the eye must be outside it.
function radius_of({ points }: Placed): number {
    let radius = 0;
    for (let i = 0; i < points.length; i += 3) {
        radius = Math.max(radius, Math.hypot(points[i]!, points[i + 1]!, points[i + 2]!));
    }
    return radius > 0 ? radius : kLooseRadius;
}

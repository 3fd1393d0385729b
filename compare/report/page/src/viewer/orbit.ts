// The eye: where it is, and how mouse, fingers, keys and flights move it.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import type { Vector } from "./rays";

/// Half the height of the view at distance 1, before `widen`.
const kTangent = Math.tan(Math.PI / 9);
const kFlight = 450;
const kStep = Math.PI / 24;
const kZoom = 1.2;
/// Where the eye is first: before the model, to the right and above.
const kFirstDirection = new three.Vector3(0.45, 0.4, 1).normalize();
/// What a model fills of the view, and the distance to one that is a point.
const kFitPart = 0.9;
const kNearestFit = 0.1;

interface Pose {
    target: three.Vector3;
    /// From the target to the eye.
    offset: three.Spherical;
}

export class Orbit {
    readonly camera = new three.PerspectiveCamera();
    private readonly canvas: HTMLCanvasElement;
    private readonly controls: OrbitControls;
    private readonly on_change: () => void;
    private flight: { from: Pose; to: Pose; start: number } | null = null;
    private frame = 0;

    constructor(canvas: HTMLCanvasElement, on_change: () => void) {
        this.canvas = canvas;
        this.on_change = on_change;
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.minDistance = 1e-4;
        this.controls.maxDistance = 1e3;
        this.controls.addEventListener("change", on_change);
        this.controls.addEventListener("start", this.land);
        canvas.addEventListener("wheel", this.land, { passive: true });
        canvas.addEventListener("keydown", this.key);
    }

    /// What `0` on the keyboard does.
    on_reset = (): void => {};

    /// `widen` is how much more than the usual is seen from bottom to top.
    set_lens(aspect: number, widen: number): void {
        const angle = three.MathUtils.radToDeg(2 * Math.atan(kTangent * widen));
        if (this.camera.aspect === aspect && this.camera.fov === angle) return;
        this.camera.aspect = aspect;
        this.camera.fov = angle;
        this.camera.updateProjectionMatrix();
    }

    /// Makes the camera's matrices; what is drawn lies within `radius` of the origin.
    prepare(radius: number): void {
        const { camera } = this;
        const near = Math.max(0.02 * this.distance(), camera.position.length() - 1.1 * radius);
        const far = camera.position.length() + 1.1 * Math.max(radius, 1) + near;
        if (camera.near !== near || camera.far !== far) {
            camera.near = near;
            camera.far = far;
            camera.updateProjectionMatrix();
        }
        camera.updateMatrixWorld();
    }

    /// From which a ball around the target fills that part of the view.
    distance_for(radius: number, part: number): number {
        const half = Math.tan(three.MathUtils.degToRad(this.camera.fov / 2)) * Math.min(1, this.camera.aspect);
        return Math.max(radius / (part * half), 2 * this.controls.minDistance);
    }

    /// These points around the origin in a view of that aspect, at once.
    fit(points: Float32Array, aspect: number): void {
        const towards = kFirstDirection;
        const right = new three.Vector3(0, 1, 0).cross(towards).normalize();
        const up = towards.clone().cross(right);
        let distance = kNearestFit;
        const point = new three.Vector3();
        for (let i = 0; i < points.length; i += 3) {
            point.fromArray(points, i);
            const side = Math.max(Math.abs(point.dot(up)), Math.abs(point.dot(right)) / aspect);
            distance = Math.max(distance, point.dot(towards) + side / (kFitPart * kTangent));
        }
        this.set(pose(new three.Vector3(), towards, distance));
    }

    /// Direction: from the target to the eye.
    fly(target: Vector, direction: Vector, distance: number): void {
        const to = pose(new three.Vector3(...target), new three.Vector3(...direction), distance);
        if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
            this.set(to);
            return;
        }
        const from = this.pose();
        // The shorter way around.
        to.offset.theta -= 2 * Math.PI * Math.round((to.offset.theta - from.offset.theta) / (2 * Math.PI));
        this.flight = { from, to, start: performance.now() };
        this.next();
    }

    /// From the target to the eye, of length 1.
    direction(): Vector {
        const { x, y, z } = this.camera.position.clone().sub(this.controls.target).normalize();
        return [x, y, z];
    }

    dispose(): void {
        this.land();
        this.canvas.removeEventListener("wheel", this.land);
        this.canvas.removeEventListener("keydown", this.key);
        this.controls.dispose();
    }

    private distance(): number {
        return this.camera.position.distanceTo(this.controls.target);
    }

    private pose(): Pose {
        const { target } = this.controls;
        return pose(target.clone(), this.camera.position.clone().sub(target), this.distance());
    }

    private set({ target, offset }: Pose): void {
        this.land();
        this.place(target, offset);
    }

    private place(target: three.Vector3, offset: three.Spherical): void {
        this.controls.target.copy(target);
        this.camera.position.setFromSpherical(offset.makeSafe()).add(target);
        // Its own event comes only for a change it can see at the scale of the model.
        this.controls.update();
        this.on_change();
    }

    private next(): void {
        cancelAnimationFrame(this.frame);
        this.frame = requestAnimationFrame((now) => this.advance(now));
    }

    private advance(now: number): void {
        if (this.flight === null) return;
        const { from, to, start } = this.flight;
        const time = Math.min(1, Math.max(0, (now - start) / kFlight));
        const part = time * time * (3 - 2 * time);
        const between = (a: number, b: number) => a + part * (b - a);
        this.place(from.target.clone().lerp(to.target, part), new three.Spherical(
            from.offset.radius * (to.offset.radius / from.offset.radius) ** part,
            between(from.offset.phi, to.offset.phi), between(from.offset.theta, to.offset.theta)));
        if (time === 1) this.flight = null;
        else this.next();
    }

    /// Ends a flight where it is.
    private readonly land = (): void => {
        this.flight = null;
        cancelAnimationFrame(this.frame);
    };

    private readonly key = (event: KeyboardEvent): void => {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        const now = this.pose();
        // The model moves with the arrow, as with the hand.
        const turn = (theta: number, phi: number) => {
            now.offset.theta += theta;
            now.offset.phi += phi;
        };
        const pan = (x: number, y: number) => {
            const step = 0.1 * this.distance();
            now.target.addScaledVector(new three.Vector3().setFromMatrixColumn(this.camera.matrix, 0), -x * step);
            now.target.addScaledVector(new three.Vector3().setFromMatrixColumn(this.camera.matrix, 1), -y * step);
        };
        const zoom = (factor: number) => now.offset.radius = three.MathUtils.clamp(
            now.offset.radius * factor, this.controls.minDistance, this.controls.maxDistance);
        const keys: Record<string, () => void> = {
            ArrowLeft: () => event.shiftKey ? pan(-1, 0) : turn(kStep, 0),
            ArrowRight: () => event.shiftKey ? pan(1, 0) : turn(-kStep, 0),
            ArrowUp: () => event.shiftKey ? pan(0, 1) : turn(0, kStep),
            ArrowDown: () => event.shiftKey ? pan(0, -1) : turn(0, -kStep),
            "+": () => zoom(1 / kZoom),
            "=": () => zoom(1 / kZoom),
            "-": () => zoom(kZoom),
            "_": () => zoom(kZoom),
        };
        const action = keys[event.key];
        if (event.key !== "0" && action === undefined) return;
        event.preventDefault();
        if (action === undefined) {
            this.on_reset();
            return;
        }
        action();
        this.set(now);
    };
}

function pose(target: three.Vector3, direction: three.Vector3, distance: number): Pose {
    return { target, offset: new three.Spherical().setFromVector3(direction.clone().setLength(distance)) };
}

// The parts of a limit page, of small data, for plots.test.mjs.
import { render } from "preact";
import { useState } from "preact/hooks";

import type { SurfaceJson } from "../src/format";
import { WaysPlot, WaysTable } from "../src/surface";

type FaceClass = SurfaceJson["classes"][number];

function class_of(name: string, faces: number, numbers: Partial<FaceClass>): FaceClass {
    return {
        class: name,
        faces,
        samples: 7 * faces,
        position: 0,
        predicted: 0,
        bound_use: 0,
        beyond_bound: 0,
        normal_degrees: 0,
        first: 0,
        second: 0,
        rate: null,
        lambda: null,
        ...numbers,
    };
}

function surface_of(method: string, numbers: Partial<SurfaceJson>): SurfaceJson {
    return {
        method,
        smooth_level: 2,
        sharp_level: 6,
        boundary: "edge-and-corner",
        creasing: "uniform",
        verdict: "known deviation",
        notes: [],
        diagonal: 1,
        without_surface: 0,
        deviations: [],
        classes: [],
        ...numbers,
    };
}

const surfaces = [
    surface_of("bfr", {
        classes: [
            class_of("regular", 8, { position: 1e-16 }),
            class_of("interior 5", 24, { position: 0.0073, predicted: 0.019, bound_use: 0.67, rate: 0.455 }),
            class_of("interior 12", 3, { position: 0.002, predicted: 0.01, bound_use: 0.2, rate: 0.58 }),
        ],
    }),
    surface_of("patch-box", {
        verdict: "differs",
        without_surface: 1,
        notes: ["A note."],
        classes: [
            class_of("regular", 8, { position: 0 }),
            class_of("interior 5", 24, { position: 0.5, predicted: 0.02, bound_use: 25, beyond_bound: 9 }),
            class_of("<script>", 2, { position: null, predicted: 0.01, bound_use: null, beyond_bound: 14 }),
        ],
    }),
    surface_of("patch-linear", { verdict: "not supported" }),
];

function LimitParts() {
    const [way, set_way] = useState(0);
    return (
        <>
            <h2>Limit</h2>
            <WaysPlot surfaces={surfaces} />
            <WaysTable surfaces={surfaces} selected={way} on_select={set_way} />
        </>
    );
}

render(<LimitParts />, document.getElementById("page")!);

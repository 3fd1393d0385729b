// What a report file holds: the contract between compare/report/html, which writes it, and this page, which reads it.
//
// The file is this page with one element a chunk,
//
//     <script type="application/x-loopcheck" id="report">BASE64</script>       a `Report`
//     <script type="application/x-loopcheck" id="case-0">BASE64</script>       what its cases and curves name
//
// A chunk is, compressed by gzip, a header and arrays:
//
//     uint32          length of the header in bytes, little-endian
//     header          JSON in UTF-8; its member `arrays` says what follows
//     arrays          one after the other, each in byte planes: all lowest bytes, then all second bytes, ...
//
// An array with `xor` is stored combined, bit for bit, with an earlier array of the same type and count: positions that
// are equal, or nearly so, then compress to nothing, and no bit is lost.

/// Elements little-endian; f32 and f64 as IEEE 754.
export type ElementType = "u8" | "u16" | "u32" | "i32" | "f32" | "f64";

export interface ArrayInfo {
    type: ElementType;
    count: number;
    /// Index of the array it is combined with.
    xor?: number;
}

/// Index into `arrays`.
export type ArrayRef = number;

export interface ChunkHeader {
    arrays: ArrayInfo[];
}

export type VerdictName =
    "identical" | "within rounding" | "known deviation" | "not supported" | "differs" | "failed";
export type BoundaryName = "edge-and-corner" | "edge-only" | "none";

/// One implementation, as in docs/report.schema.json.
export interface SubjectInfo {
    name: string;
    version: string;
    precision: "double" | "float";
    supports: string;
}

/// A known deviation that a report names.
export interface DeviationInfo {
    name: string;
    kind: "error" | "approximation" | "documented";
    family: string;
    what: string;
    versions: string;
    /// Path in the project: docs/deviations/NAME.md.
    page: string;
}

/// Header of the chunk `report`.
export interface Report extends ChunkHeader {
    version: string;
    command: "compare" | "suite" | "limit" | "curve";
    exit_code: number;
    /// The verdict in one sentence.
    sentence: string;
    levels: number;
    subjects: SubjectInfo[];
    deviations: DeviationInfo[];
    /// In the order of the command: models by name, then boundary options.
    cases: CaseSummary[];
    unreadable: { model: string; code: string; error: string }[];
}

/// One model under one choice of rules.
export interface CaseSummary {
    model: string;
    /// Id of its chunk; absent where there is none. Cases that are alike share one.
    chunk?: string;
    boundary: BoundaryName;
    creasing: string;
    weights: string;
    vertices: number;
    faces: number;
    boundary_edges: number;
    /// compare and suite: one a pair of subjects; limit: one a way of evaluation; curve: one a peer.
    results: ResultSummary[];
}

export interface ResultSummary {
    subject: string;
    reference: string;
    /// "refinement", "limits", a way of evaluation ("bfr", ...), or the mesh that carries the curve.
    what: string;
    verdict: VerdictName;
    /// Names of known deviations that were seen.
    deviations: string[];
    /// Largest difference: model units, and in u M; null where nothing was compared or it is not finite.
    largest: number | null;
    largest_in_uM: number | null;
    notes: string[];
}

/// Header of a chunk of a mesh.
export interface Case extends ChunkHeader {
    kind: "mesh";
    /// The comparisons as in docs/report.schema.json, with classes and worst vertices, but for the model and the rules,
    /// which the `CaseSummary` has: cases that are alike share a chunk (compare, suite); else empty.
    comparisons: ComparisonJson[];
    /// The surfaces as there (limit); else empty.
    surfaces: SurfaceJson[];
    /// Largest coordinate M and u M in double, model units.
    largest_coordinate: number;
    /// Vertex classes, "interior 5"; rules, "vertex point, crease"; deviations; face classes (limit only).
    classes: string[];
    rules: string[];
    deviations: string[];
    face_classes: string[];
    /// The weights of a mask, in the order of `ring`: fractions where they are, else decimals.
    masks: { weights: string[] }[];
    levels: Level[];
    /// Levels that were compared and are too large for the file.
    left_out: { level: number; vertices: number }[];
    /// A point a class and level: largest distance of its vertices from their limits, in model units, by the exact
    /// rules; and the factor by which it shrinks a level in the end, where that is known. 
    convergence: { class: string; level: number; vertices: number; distance: number; factor: number | null }[];
}

/// One level, vertices in our order.
export interface Level {
    level: number;
    vertices: number;
    /// u32, three a face. Face f of the level before became faces 4f to 4f + 3.
    triangles: ArrayRef;
    /// u32, the two ends of each edge that is sharp or still semi-sharp and no boundary.
    sharp: ArrayRef;
    /// i32, one a vertex: index v of the parent's vertex, or -1 - (3f + i) for edge i of its face f; absent at level 0.
    ancestors?: ArrayRef;
    /// u8, u16 or u32, whichever is enough: index into `classes`, `rules`.
    classes: ArrayRef;
    rules?: ArrayRef;
    /// u32: index into `masks`, and where the vertices of the parent level that it reads begin in `ring` (one more than
    /// vertices).
    masks?: ArrayRef;
    ring_at?: ArrayRef;
    ring?: ArrayRef;
    /// What subjects made, f64, three a vertex in model units, and the exact positions; u32, the number that the
    /// subject gives each vertex, absent where it is ours.
    exact?: ArrayRef;
    positions: { subject: string; positions: ArrayRef; order?: ArrayRef }[];
    /// The same of limits: exact normals are zero where there is none.
    limits?: {
        exact: ArrayRef;
        exact_normals: ArrayRef;
        positions: { subject: string; positions: ArrayRef; normals: ArrayRef }[];
    };
    /// As `Case.comparisons`: what the referee says of each vertex; null where nothing was compared.
    comparisons: (VertexNumbers | null)[];
    /// As `Case.surfaces`, at level 0 only: what was seen of each face; null where nothing was compared.
    surfaces?: (FaceNumbers | null)[];
}

/// f32, in u M of the comparison; infinite where something is not finite.
export interface VertexNumbers {
    subject_error: ArrayRef;
    reference_error: ArrayRef;
    bound: ArrayRef;
    bound_use: ArrayRef;
    limits?: {
        subject_error: ArrayRef;
        reference_error: ArrayRef;
        bound: ArrayRef;
        bound_use: ArrayRef;
        /// Degrees between the normals, f32: NaN where there are none to compare.
        normal: ArrayRef;
        normal_bound: ArrayRef;
        /// u8: 0, or 1 + index into `Case.deviations` of the one that shows, as predicted.
        deviation: ArrayRef;
    };
    /// u8, as above, in refinement; absent where none shows.
    deviation?: ArrayRef;
}

/// One a face of the control mesh; NaN where the face was not looked at or has no surface, infinite where it should have
/// one and has not.
export interface FaceNumbers {
    /// f32, largest coordinate of the difference in u M of double, and the largest bound of it.
    position: ArrayRef;
    bound: ArrayRef;
    /// f32, largest angle between the normals in degrees.
    normal: ArrayRef;
    /// u8, u16 or u32, whichever is enough: index into `face_classes`, the last of which may be "not looked at".
    face_class: ArrayRef;
}

/// Error statistics of docs/report.schema.json; null where not finite.
export interface ErrorJson {
    identical: number;
    not_finite: number;
    max: number | null;
    mean: number | null;
    rms: number | null;
    max_in_uM: number | null;
}
export interface ClassJson {
    class: string;
    vertices: number;
    difference: ErrorJson & { max_over_diagonal?: number | null };
    subject_error: ErrorJson;
    reference_error: ErrorJson;
    bound_use: number | null;
    beyond_bound: number;
    predicted: number | null;
    /// Largest bound of a vertex of the class, in u M.
    largest_bound_in_uM: number | null;
}
export interface PointJson {
    decimal: (number | null)[];
    hex: string[];
}
export interface VertexJson {
    vertex: number;
    subject_vertex: number;
    reference_vertex: number;
    class: string;
    rule: string;
    error: number | null;
    subject_error: number | null;
    reference_error: number | null;
    bound: number | null;
    bound_use: number | null;
    subject: PointJson;
    reference: PointJson;
    exact: PointJson;
    ancestor?: { vertex: number } | { face: number; edge: number };
}
export interface LimitWorstJson {
    position: VertexJson;
    deviation?: string;
    no_normal?: string;
    normal?: { error: number | null; bound: number | null; bound_use: number | null };
}
export interface LevelJson<Entry, Worst> {
    level: number;
    verdict: VerdictName;
    faces?: number;
    classes: Entry[];
    worst: Worst[];
}
export interface ComparisonJson {
    subject: string;
    reference: string;
    verdict: VerdictName;
    notes: string[];
    deviation?: string;
    largest_coordinate: number;
    diagonal: number;
    uM: number;
    levels: LevelJson<ClassJson, VertexJson>[];
    limits?: {
        verdict: VerdictName;
        notes: string[];
        deviations: { name: string; kind: string; subject: string; vertices: number }[];
        levels: LevelJson<{ class: string; position: Omit<ClassJson, "class">; normal: unknown }, LimitWorstJson>[];
    };
}
export interface SurfaceJson {
    method: string;
    smooth_level: number;
    sharp_level: number;
    boundary: string;
    creasing: string;
    verdict: VerdictName;
    notes: string[];
    diagonal: number | null;
    without_surface: number;
    deviations: { name: string; expected: number; shown: number; missing: number; largest: number }[];
    classes: {
        class: string;
        faces: number;
        samples: number;
        position: number | null;
        predicted: number | null;
        bound_use: number | null;
        beyond_bound: number;
        normal_degrees: number | null;
        first: number | null;
        second: number | null;
        rate: number | null;
        lambda: number | null;
    }[];
}

/// Header of a chunk of a curve.
export interface CurveCase extends ChunkHeader {
    kind: "curve";
    file: string;
    dimension: 2 | 3;
    degree: number;
    ends: string;
    /// The two coordinates that vary most, which a drawing shows.
    drawn: [number, number];
    /// f64, three a point: the control points and each level; the curve at each point's parameter, NaN outside the domain.
    levels: { level: number; points: ArrayRef; on_curve: ArrayRef }[];
    left_out: { level: number; points: number }[];
    /// f64, three a point: the exact curve, closely sampled.
    exact: ArrayRef;
    /// The whole report as in docs/report.schema.json.
    curve: CurveJson;
}
/// Only what this page reads.
export interface CurveJson {
    verdict: VerdictName;
    notes: string[];
    levels: {
        level: number;
        points: number;
        distance: number | null;
        allowed?: number | null;
        error: number | null;
        bound_use: number | null;
    }[];
}

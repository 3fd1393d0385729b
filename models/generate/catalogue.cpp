// The table of models, one function per subject, in the order of the index.
#include "models/generate/catalogue.h"

#include <array>
#include <cstdio>
#include <string>

#include "models/generate/cow.h"
#include "models/generate/shapes.h"
#include "models/generate/tags.h"
#include "models/generate/variations.h"

namespace loopcheck::models {
namespace {

// Two meshes carry most of the tags. The globe is closed: rings 1 and 2 have valence 6, rings 0 and 3
// have 5, the poles 6. The grid is open: its interior vertices have valence 6.
constexpr int kColumns = 6;
constexpr int kRings = 4;
constexpr int kNorth = 0;
constexpr int kCells = 4;

Mesh small_globe() {
    return globe(kColumns, kRings);
}
Mesh small_grid() {
    return grid(kCells, kCells);
}

/// Vertex of the globe.
int on_globe(int ring, int column) {
    return globe_vertex(kColumns, ring, column);
}

/// Vertex of the grid.
int on_grid(int row, int column) {
    return grid_vertex(kCells, row, column);
}

/// Ring of the globe as a closed path.
std::vector<int> ring(int ring_index) {
    std::vector<int> path;
    for (int column = 0; column <= kColumns; ++column) path.push_back(on_globe(ring_index, column));
    return path;
}

/// Meridian of the globe from the ring next to one pole to the ring next to the other.
std::vector<int> meridian(int column) {
    return {on_globe(0, column), on_globe(1, column), on_globe(2, column), on_globe(3, column)};
}

/// From the ring over the north pole to the next place of the ring.
std::vector<int> across_north(int column) {
    return {on_globe(0, column), kNorth, on_globe(0, column + 1)};
}

/// Row of the grid from boundary to boundary.
std::vector<int> row(int row_index) {
    std::vector<int> path;
    for (int column = 0; column <= kCells; ++column) path.push_back(on_grid(row_index, column));
    return path;
}

/// "name-07": numbers of two digits keep the files in order.
std::string numbered(const std::string& name, int number) {
    std::array<char, 16> digits = {};
    std::snprintf(digits.data(), digits.size(), "-%02d", number);
    return name + digits.data();
}

std::vector<Model> solids() {
    return {
        {"tetrahedron", "the smallest closed mesh without a double edge: valence 3 everywhere",
         tetrahedron()},
        {"octahedron", "closed, valence 4 everywhere", octahedron()},
        {"icosahedron", "closed, valence 5 everywhere", icosahedron()},
        {"split-icosahedron",
         "closed, irregular vertices (valence 5) apart from each other among regular ones",
         split_icosahedron()},
        {"pillow", "two triangles glued along all three edges: interior valence 2", pillow()},
        {"torus", "genus 1, and regular: valence 6 everywhere", torus(8, 5)},
        {"genus-2", "genus 2: a slab with two tunnels", slab_with_tunnels(2)},
        {"mixed-valence", "closed, every valence from 3 to 9 in one mesh",
         with_random_flips(split_icosahedron(), 120, 3, 9)},
    };
}

std::vector<Model> bipyramids() {
    std::vector<Model> models;
    for (const int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 49, 50, 64, 360}) {
        models.push_back({numbered("bipyramid", n),
                          "two apexes of valence " + std::to_string(n) + ", a ring of valence 4",
                          bipyramid(n)});
    }
    return models;
}

std::vector<Model> open_meshes() {
    std::vector<Model> models = {
        {"single-triangle",
         "the smallest mesh: one face, three boundary corners",
         {{{0.4, 0.3, 1.2}, {1.7, 0.6, 0.9}, {0.8, 1.9, 1.6}}, {{0, 1, 2}}}},
        {"square-diagonal-a", "two triangles, split from vertex 0 to 2", square(Diagonal::From0To2)},
        {"square-diagonal-b", "the same square split from vertex 1 to 3", square(Diagonal::From1To3)},
        {"grid-4x4", "open, interior vertices regular, boundary vertices of 1, 2 and 3 faces", small_grid()},
        {"grid-irregular-4", "open, one interior vertex of valence 4 among regular ones", disc(4, 3)},
        {"grid-irregular-7", "open, one interior vertex of valence 7 among regular ones", disc(7, 3)},
        {"grid-irregular-9", "open, one interior vertex of valence 9 among regular ones", disc(9, 2)},
        {"annulus", "a closed band one face thick: two boundaries, every vertex on one of them", annulus(7)},
        {"boundary-corner-1-face", "a boundary vertex of exactly 1 face, at the tip of a sector",
         sector(1, 4)},
        {"boundary-corner-2-faces", "a boundary vertex of exactly 2 faces, at the tip of a sector",
         sector(2, 3)},
        {"boundary-corner-3-faces", "a boundary vertex of exactly 3 faces, the regular boundary case",
         sector(3, 3)},
        {"boundary-corner-4-faces", "a boundary vertex of 4 faces, more than regular", sector(4, 3)},
        {"boundary-vertex-20-faces", "a boundary vertex of 20 faces", sector(20, 1)},
        {"boundary-edge-and-corner", "interpolateboundary 1: boundary vertices of one face stay put",
         with_boundary(grid(2, 2), InterpolateBoundary::EdgeAndCorner)},
        {"boundary-edge-only", "interpolateboundary 2: boundary vertices of one face follow the crease rule",
         with_boundary(grid(2, 2), InterpolateBoundary::EdgeOnly)},
        {"boundary-none", "interpolateboundary 0: refines like 2, but no limit surface at the boundary",
         with_boundary(grid(2, 2), InterpolateBoundary::None)},
    };
    for (int k = 1; k <= 9; ++k) {
        models.push_back({"fan-" + std::to_string(k),
                          "an open fan: " + std::to_string(k) + (k == 1 ? " face" : " faces") +
                              " around a boundary vertex",
                          sector(k, 1)});
    }
    return models;
}

std::vector<Model> creases() {
    const int middle = on_grid(2, 2);
    return {
        {"crease-straight", "a straight infinitely sharp path across a closed mesh, darts of valence 5",
         with_crease(small_globe(), meridian(2), kInfinite)},
        {"crease-loop", "a closed infinitely sharp loop of regular vertices",
         with_crease(small_globe(), ring(1), kInfinite)},
        {"crease-loop-irregular", "a closed infinitely sharp loop of vertices of valence 5",
         with_crease(small_globe(), ring(0), kInfinite)},
        {"crease-loop-one-face", "the three edges of one face infinitely sharp: the shortest loop",
         with_crease(small_globe(), {on_globe(1, 1), on_globe(2, 1), on_globe(2, 2), on_globe(1, 1)},
                     kInfinite)},
        {"crease-everywhere", "every edge infinitely sharp: every vertex a corner",
         with_crease(with_crease(tetrahedron(), {0, 1, 2, 0, 3, 1}, kInfinite), {2, 3}, kInfinite)},
        {"crease-branching", "three infinitely sharp paths meet in one vertex: a corner",
         with_crease(
             with_crease(small_globe(), {on_globe(1, 0), on_globe(0, 0), kNorth, on_globe(0, 2)}, kInfinite),
             {kNorth, on_globe(0, 4), on_globe(1, 4)}, kInfinite)},
        {"crease-crossing", "two infinitely sharp paths cross: four sharp edges at a vertex",
         with_crease(with_crease(small_globe(), ring(1), kInfinite), meridian(3), kInfinite)},
        {"crease-one-edge", "a single infinitely sharp edge: regular darts at both ends",
         with_crease(small_globe(), {on_globe(1, 3), on_globe(2, 3)}, kInfinite)},
        {"crease-two-darts",
         "an infinitely sharp path of three edges inside the mesh, regular darts at both ends",
         with_crease(small_globe(), {on_globe(1, 0), on_globe(1, 1), on_globe(2, 2), on_globe(2, 3)},
                     kInfinite)},
        {"crease-bent", "an infinitely sharp path that turns: sectors of 1 and 5 faces",
         with_crease(small_globe(), {on_globe(1, 1), on_globe(1, 2), on_globe(2, 2)}, kInfinite)},
        {"crease-across-boundary", "an infinitely sharp path from boundary to boundary: corners at its ends",
         with_crease(small_grid(), row(2), kInfinite)},
        {"crease-from-boundary", "an infinitely sharp path from the boundary to a regular dart inside",
         with_crease(small_grid(), {on_grid(0, 2), on_grid(1, 2), middle}, kInfinite)},
        {"crease-on-boundary", "a crease tag on boundary edges, which are sharp already: it changes nothing",
         with_crease(small_grid(), {on_grid(0, 1), on_grid(0, 2), on_grid(0, 3)}, 1.5)},
        {"crease-through-valence-3",
         "an infinitely sharp path over a vertex of valence 3: sectors of 1 and 2 faces",
         with_crease(disc(3, 3), {5, 1, 0, 2, 7}, kInfinite)},
        {"crease-through-valence-9",
         "an infinitely sharp path over a vertex of valence 9: sectors of 2 and 7 faces",
         with_crease(disc(9, 2), {1, 0, 3}, kInfinite)},
        {"crease-meets-corner", "two infinitely sharp edges meet in a vertex tagged as corner",
         with_corner(with_crease(small_globe(), meridian(4), kInfinite), on_globe(1, 4), kInfinite)},
        {"crease-nearby", "two single infinitely sharp edges, one edge apart from each other",
         with_crease(with_crease(small_grid(), {on_grid(1, 1), on_grid(2, 1)}, kInfinite),
                     {on_grid(2, 2), on_grid(3, 3)}, kInfinite)},
    };
}

std::vector<Model> darts() {
    std::vector<Model> models;
    for (const int n : {3, 4, 5, 6, 7, 9, 12}) {
        models.push_back(
            {numbered("dart-valence", n),
             "an infinitely sharp path of two edges, darts of valence " + std::to_string(n) + " at both ends",
             with_crease(bipyramid(n), {n, 0, n + 1}, kInfinite)});
    }
    return models;
}

std::vector<Model> sharp_vertices() {
    return {
        {"corner-interior", "an infinitely sharp vertex without sharp edges, in the interior",
         with_corner(small_globe(), on_globe(1, 1), kInfinite)},
        {"corner-boundary", "an infinitely sharp vertex on the boundary, with three faces",
         with_corner(small_grid(), on_grid(0, 2), kInfinite)},
        {"corner-dart", "an infinitely sharp vertex at the end of an infinitely sharp edge",
         with_corner(with_crease(small_globe(), {on_globe(1, 2), on_globe(2, 2)}, kInfinite), on_globe(2, 2),
                     kInfinite)},
        {"corner-all-of-a-face", "three infinitely sharp vertices of one face",
         with_corner(with_corner(with_corner(icosahedron(), 0, kInfinite), 1, kInfinite), 2, kInfinite)},
        {"semi-sharp-vertex-0.5", "a vertex of sharpness 0.5: smooth after one step, by a blend",
         with_corner(small_globe(), on_globe(1, 1), 0.5)},
        {"semi-sharp-vertex-1.5", "a vertex of sharpness 1.5: kept for one step, then blended",
         with_corner(small_globe(), on_globe(1, 1), 1.5)},
        {"semi-sharp-vertex-2", "a vertex of sharpness 2: kept for two steps, no blend",
         with_corner(small_globe(), kNorth, 2)},
        {"semi-sharp-vertex-boundary", "a boundary vertex of sharpness 1.3: decays to the boundary curve",
         with_corner(small_grid(), on_grid(2, 0), 1.3)},
        {"semi-sharp-vertex-on-crease",
         "a vertex of sharpness 1.4 on an infinitely sharp loop: corner to crease",
         with_corner(with_crease(small_globe(), ring(2), kInfinite), on_globe(2, 2), 1.4)},
        {"semi-sharp-vertex-and-edges", "a vertex of sharpness 0.6 where two edges of 1.7 meet: both blend",
         with_corner(with_crease(small_globe(), {on_globe(1, 0), on_globe(1, 1), on_globe(1, 2)}, 1.7),
                     on_globe(1, 1), 0.6)},
    };
}

/// The same path with sharpness after sharpness.
std::vector<Model> semi_sharp_ladder() {
    std::vector<Model> models;
    for (const char* sharpness : {"0.25", "0.5", "1", "1.5", "2.5", "3"}) {
        models.push_back({std::string("semi-sharp-edge-") + sharpness,
                          std::string("a path of three edges of sharpness ") + sharpness,
                          with_crease(small_globe(), meridian(1), std::stod(sharpness))});
    }
    return models;
}

std::vector<Model> semi_sharp_edges() {
    const int a = on_globe(2, 0), b = on_globe(2, 1), c = on_globe(2, 2), d = on_globe(2, 3);
    return {
        {"semi-sharp-loop", "a closed loop of sharpness 1.25: crease, then smooth, no ends",
         with_crease(small_globe(), ring(2), 1.25)},
        {"semi-sharp-one-edge", "a single edge of sharpness 0.75: both ends darts, then smooth",
         with_crease(small_globe(), {b, c}, 0.75)},
        {"semi-sharp-unequal", "edges of sharpness 0.3 and 1.7 meet: the vertex is a dart after one step",
         with_graded_crease(small_globe(), {a, b, c}, {0.3, 1.7})},
        {"semi-sharp-both-fractional", "edges of sharpness 0.3 and 0.8 meet: both end in the same step",
         with_graded_crease(small_globe(), {a, b, c}, {0.3, 0.8})},
        {"semi-sharp-between-infinite", "an edge of sharpness 1.5 between infinitely sharp ones",
         with_graded_crease(small_globe(), {a, b, c, d}, {kInfinite, 1.5, kInfinite})},
        {"semi-sharp-to-dart", "an infinitely sharp path goes on with sharpness 0.6: crease decays to dart",
         with_graded_crease(small_globe(), {a, b, c, d}, {kInfinite, kInfinite, 0.6})},
        {"semi-sharp-three-ends", "edges of 0.7, 1.6 and 2.5 at one vertex: corner, crease, dart, smooth",
         with_crease(with_graded_crease(small_globe(), {b, c, d}, {0.7, 1.6}), {c, on_globe(1, 2)}, 2.5)},
        {"semi-sharp-corner-to-crease", "an edge of sharpness 0.8 meets an infinitely sharp loop",
         with_crease(with_crease(small_globe(), ring(2), kInfinite), {c, on_globe(1, 2)}, 0.8)},
        {"semi-sharp-crossing", "a path of 0.4 crosses a path of 1.6: four sharp edges, then two, then none",
         with_crease(with_crease(small_grid(), {on_grid(2, 1), on_grid(2, 2), on_grid(2, 3)}, 0.4),
                     {on_grid(1, 2), on_grid(2, 2), on_grid(3, 2)}, 1.6)},
        {"semi-sharp-at-boundary", "an edge of sharpness 1.5 ends on the boundary: corner to boundary curve",
         with_crease(small_grid(), {on_grid(0, 2), on_grid(1, 2)}, 1.5)},
        {"semi-sharp-many-at-vertex", "all six edges of a vertex with sharpness 0.2, 0.4, ... 1.2",
         with_graded_crease(with_graded_crease(with_graded_crease(small_globe(), across_north(0), {0.2, 0.4}),
                                               across_north(2), {0.6, 0.8}),
                            across_north(4), {1.0, 1.2})},
        {"semi-sharp-below-infinite", "sharpness 9.5, the side of 10 that still decays",
         with_crease(small_globe(), meridian(5), 9.5)},
        {"semi-sharp-valence-3", "edges of sharpness 0.7 meet at a vertex of valence 3",
         with_crease(bipyramid(3), {0, 3, 1}, 0.7)},
        {"semi-sharp-valence-9", "edges of sharpness 1.3 meet at a vertex of valence 9",
         with_crease(bipyramid(9), {0, 9, 4}, 1.3)},
    };
}

std::vector<Model> chaikin_creases() {
    const int a = on_globe(1, 0), b = on_globe(1, 1), c = on_globe(1, 2), d = on_globe(1, 3),
              e = on_globe(1, 4);
    return {
        {"chaikin-pair", "Chaikin, edges of sharpness 0.5 and 2 meet: unequal neighbours",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c}, {0.5, 2}))},
        {"chaikin-graded", "Chaikin, a chain of sharpness 0.4, 0.9, 2.2, 3.1",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c, d, e}, {0.4, 0.9, 2.2, 3.1}))},
        {"chaikin-weak-between-strong",
         "Chaikin, an edge of sharpness 0.9 between edges of 3: its neighbours keep it sharp at both ends",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c, d}, {3, 0.9, 3}))},
        {"chaikin-loop", "Chaikin, a closed loop of sharpness 1.5, 1.7, 1.9, 1.8, 1.65, 1.6",
         with_chaikin(with_graded_crease(small_globe(), ring(1), {1.5, 1.7, 1.9, 1.8, 1.65, 1.6}))},
        {"chaikin-below-1", "Chaikin, a chain of sharpness 0.2, 0.7, 0.45: all end in the first step",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c, d}, {0.2, 0.7, 0.45}))},
        {"chaikin-infinite-neighbour", "Chaikin, an edge of sharpness 1.8 between infinitely sharp ones",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c, d}, {kInfinite, 1.8, kInfinite}))},
        {"chaikin-one-edge", "Chaikin, a single edge of sharpness 1.7: no neighbour, so it decays uniformly",
         with_chaikin(with_crease(small_globe(), {b, c}, 1.7))},
        {"chaikin-branching", "Chaikin, three edges of sharpness 0.5, 1.6 and 2.9 at one vertex",
         with_chaikin(with_crease(with_graded_crease(small_globe(), {b, c, d}, {0.5, 1.6}),
                                  {c, on_globe(2, 2)}, 2.9))},
        {"chaikin-vertex", "Chaikin, a vertex of sharpness 0.9 between edges of 1.5 and 2",
         with_chaikin(with_corner(with_graded_crease(small_globe(), {a, b, c}, {1.5, 2}), b, 0.9))},
        {"chaikin-overweight",
         "Chaikin, an edge of 1.2 between edges of 0.05 ends in one step: OpenSubdiv 3.5 weighs it 1.2",
         with_chaikin(with_graded_crease(small_globe(), {a, b, c, d}, {0.05, 1.2, 0.05}))},
    };
}

std::vector<Model> holes() {
    return {
        {"hole-closed", "a hole tag in a closed mesh: its face is refined and not drawn",
         with_hole(small_globe(), 9)},
        {"hole-open", "a hole tag in an open mesh, away from the boundary", with_hole(small_grid(), 10)},
        {"hole-at-crease", "two hole tags on both sides of an infinitely sharp edge",
         with_hole(with_hole(with_crease(small_grid(), row(2), kInfinite), 11), 18)},
    };
}

std::vector<Model> components() {
    return {
        {"isolated-vertex-middle", "a vertex of no face in the middle of the list",
         with_isolated_vertex(icosahedron(), 5)},
        {"isolated-vertex-last", "a vertex of no face at the end of the list",
         with_isolated_vertex(icosahedron(), 12)},
        {"two-components", "two closed meshes that do not touch", side_by_side(icosahedron(), bipyramid(7))},
        {"two-components-open-closed", "a closed and an open mesh that do not touch",
         side_by_side(octahedron(), disc(5, 2))},
    };
}

std::vector<Model> magnitudes() {
    constexpr double kFar = 1e6;
    constexpr double kTiny = 1e-6;
    constexpr int kTinyDecimals = kDecimals + 6;
    return {
        {"magnitude-large", "coordinates near one million: few digits left for the shape",
         moved(split_icosahedron(), kFar)},
        {"magnitude-small", "coordinates near one millionth",
         scaled(split_icosahedron(), kTiny, kTinyDecimals)},
        {"magnitude-mixed", "coordinates near one million, one and one millionth side by side",
         with_mixed_magnitudes(icosahedron())},
    };
}

/// Irregular, open and with tags that break every symmetry: for the ways to write one shape.
Mesh written_shape() {
    return with_corner(with_graded_crease(disc(7, 2), {0, 1, 9, 10}, {kInfinite, 1.6, 0.7}), 4, 0.8);
}

std::vector<Model> spellings() {
    return {
        {"rotated-indices-a", "one shape in five spellings; here face f starts at its vertex 0",
         written_shape()},
        {"rotated-indices-b", "the shape of rotated-indices-a, face f starting at its vertex f mod 3",
         with_rotated_faces(written_shape(), 1)},
        {"rotated-indices-c", "the shape of rotated-indices-a, face f starting at its vertex 2f mod 3",
         with_rotated_faces(written_shape(), 2)},
        {"permuted-vertices", "the shape of rotated-indices-a with vertex v renumbered as (5v + 1) mod 22",
         with_renumbered_vertices(written_shape(), 5)},
        {"permuted-faces", "the shape of rotated-indices-a with the faces from last to first",
         with_reversed_face_order(written_shape())},
    };
}

std::vector<Model> figures() {
    return {
        {"cow", "a cow: closed, mixed valences, thin parts, something to look at", cow()},
        {"cow-creased", "the cow with infinitely sharp soles and a semi-sharp edge round the muzzle",
         cow_with_creases()},
    };
}

}  // namespace

std::vector<Model> catalogue() {
    std::vector<Model> models;
    for (const auto& subject :
         {solids, bipyramids, open_meshes, creases, darts, sharp_vertices, semi_sharp_ladder,
          semi_sharp_edges, chaikin_creases, holes, components, magnitudes, spellings, figures}) {
        for (Model& model : subject()) models.push_back(std::move(model));
    }
    return models;
}

}  // namespace loopcheck::models

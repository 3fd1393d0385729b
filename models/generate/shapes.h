// Shapes without tags. Every one is off-centre and lopsided, because symmetry hides errors, and
// faces are counter-clockwise seen from outside (closed) or from above (open).
#pragma once

#include "models/generate/mesh.h"

namespace loopcheck::models {

Mesh tetrahedron();
Mesh octahedron();
Mesh icosahedron();

/// Vertices: ring 0 .. n-1, apex n, opposite apex n+1. Both apexes have valence n, the ring 4.
Mesh bipyramid(int n);

/// Two triangles glued along all three edges: three vertices of valence 2.
Mesh pillow();

/// A sphere of meridians: pole 0, `rings` rings of `columns` vertices (see `globe_vertex`), other pole
/// last. The poles have valence `columns`, the rings next to them 5, the other rings 6.
Mesh globe(int columns, int rings);
int globe_vertex(int columns, int ring, int column);

/// The icosahedron with each face split in four: 42 vertices of valence 5 and 6.
Mesh split_icosahedron();

/// A torus of valence 6 everywhere.
Mesh torus(int columns, int rows);

/// A slab of unit cubes with `tunnels` square tunnels in a row; its genus is `tunnels`.
Mesh slab_with_tunnels(int tunnels);

/// Vertices row by row; the diagonal of each cell starts at its lower left corner.
Mesh grid(int columns, int rows);
int grid_vertex(int columns, int row, int column);

enum class Diagonal { From0To2, From1To3 };
Mesh square(Diagonal diagonal);

/// Vertex 0 on the boundary with k faces; ring j around it has k j + 1 vertices.
Mesh sector(int k, int rings);

/// Vertex 0 in the interior with valence n; ring j around it has n j vertices.
Mesh disc(int n, int rings);

/// A closed band one face thick: inner ring 0 .. n-1, outer ring n .. 2n-1.
Mesh annulus(int n);

}  // namespace loopcheck::models

// What the limit surface of a face is like at one of its corners, as a class: errors of one class have one
// cause.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

#include "core/loop/corner_view.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// The class of a corner of a face: of the vertex, within the sector that holds the face.
struct CornerClass {
    enum class Kind : std::uint8_t {
        Regular,      ///< one quartic box spline
        Interior,     ///< smooth, with `faces` faces
        Boundary,     ///< a crease or a boundary, `faces` faces in the sector
        Corner,       ///< infinitely sharp with two sharp edges or more, `faces` faces in the sector
        Dart,         ///< one infinitely sharp edge, `faces` faces around
        Cone,         ///< infinitely sharp itself without a sharp edge, `faces` faces around
        CreasedCone,  ///< the same with one infinitely sharp edge
        SemiSharp,    ///< something at it is semi-sharp
    };
    Kind kind = Kind::Regular;
    int faces = 0;  ///< 0 where regular or semi-sharp

    auto operator<=>(const CornerClass&) const = default;
};

/// "interior 5", "boundary 4", "corner 2", "dart 7", "cone 6", "creased cone 6", "semi-sharp", "regular".
std::string to_string(CornerClass c);

CornerClass class_of(const core::CornerView& view);

/// The largest eigenvalue but for 1 of the refinement of the ring: what the ring shrinks by a level, and so
/// what an approximation on it does.
///
///     interior                3/8 + cos(2 pi/n)/4
///     boundary, corner        max(1/2, 3/8 + cos(pi/k)/4)
///     dart                    max(3/8 + cos(2 pi/n)/4, that of the even tangent)
///     cone                    5/8
///     creased cone            max(1/2, 3/8 + cos(pi/n)/4)
///
/// Source   docs facts: core/loop/limit.h.
/// Range    regular (1/2) and every class with a number of faces; nothing for a semi-sharp one.
std::optional<double> eigenvalue(CornerClass c);

/// The smallest mesh in which vertex 0 is of this class and nothing else around it is irregular: as many
/// wedges of the triangular lattice as there are faces, three steps deep.  Faces 0, ..., c.faces - 1 are
/// those at vertex 0, which is their corner 0, counter-clockwise; on a dart the sharp path leaves between the
/// last and the first.  For BoundaryRule::EdgeOnly.
///
/// Range    regular (as interior 6); interior, dart and cones from 3 faces, boundaries and corners from 1:
///          else nothing.
std::optional<core::TriangleMesh> local_mesh(CornerClass c);

}  // namespace loopcheck::compare

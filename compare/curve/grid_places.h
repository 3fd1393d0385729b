// Which vertex of a refined mesh of quads is which point of the grid, by ancestry.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/bspline/curve.h"
#include "reference/opensubdiv/catmull_clark.h"

namespace loopcheck::compare {

/// Row i and column j of a grid.
struct GridPlace {
    std::size_t i = 0, j = 0;

    bool operator==(const GridPlace&) const = default;
};

/// The places of all vertices of a level, each place once.
struct GridPlaces {
    std::size_t rows = 0, columns = 0;
    core::Ends u = core::Ends::Natural, v = core::Ends::Natural;  ///< along the rows and the columns
    std::vector<GridPlace> of_vertex;
};

/// Those of `quad_mesh`: row after row.
GridPlaces places_of_grid(std::size_t rows, std::size_t columns, core::Ends u, core::Ends v);

/// Those of the next level: (2 i, 2 j) for a vertex of (i, j), and between its parents for an edge or a face.
/// Nothing where a parent does not exist, where parents are not one, two neighbours or the corners of a face,
/// or where not every place is taken once.
std::optional<GridPlaces> places_of_children(const GridPlaces& parents,
                                             std::span<const reference::QuadAncestor> ancestors);

}  // namespace loopcheck::compare

#include "compare/curve/grid_places.h"

#include <algorithm>
#include <utility>

namespace loopcheck::compare {
namespace {

// The place between two of a direction with n places, or twice the place where they are one.
std::optional<std::size_t> between(std::size_t a, std::size_t b, std::size_t n, core::Ends ends) {
    if (a > b) std::swap(a, b);
    if (b - a <= 1) return a + b;
    if (ends == core::Ends::Closed && a == 0 && b == n - 1) return 2 * n - 1;
    return std::nullopt;
}

// The place of a vertex from those of its parents: they are one, or two neighbours, or the corners of a face.
std::optional<GridPlace> child_place(const reference::QuadAncestor& ancestor, const GridPlaces& parents) {
    if (ancestor.count != 1 && ancestor.count != 2 && ancestor.count != 4) return std::nullopt;
    std::vector<GridPlace> from;
    for (std::size_t k = 0; k < ancestor.count; ++k) {
        const core::Index v = ancestor.vertices[k];
        if (v < 0 || static_cast<std::size_t>(v) >= parents.of_vertex.size()) return std::nullopt;
        const GridPlace place = parents.of_vertex[v];
        if (std::find(from.begin(), from.end(), place) != from.end()) return std::nullopt;
        from.push_back(place);
    }
    // The row and column of the first, and any others; a third has no place in their product.
    GridPlace other = from[0];
    for (const GridPlace& place : from) {
        if (place.i != from[0].i) other.i = place.i;
        if (place.j != from[0].j) other.j = place.j;
    }
    for (const GridPlace& place : from)
        if ((place.i != from[0].i && place.i != other.i) || (place.j != from[0].j && place.j != other.j))
            return std::nullopt;
    const std::size_t rows = other.i == from[0].i ? 1 : 2, columns = other.j == from[0].j ? 1 : 2;
    const auto i = between(from[0].i, other.i, parents.rows, parents.v);
    const auto j = between(from[0].j, other.j, parents.columns, parents.u);
    if (rows * columns != from.size() || !i || !j) return std::nullopt;
    return GridPlace{*i, *j};
}

}  // namespace

GridPlaces places_of_grid(std::size_t rows, std::size_t columns, core::Ends u, core::Ends v) {
    GridPlaces out{rows, columns, u, v, {}};
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) out.of_vertex.push_back({i, j});
    return out;
}

std::optional<GridPlaces> places_of_children(const GridPlaces& parents,
                                             std::span<const reference::QuadAncestor> ancestors) {
    const auto refined = [](std::size_t n, core::Ends ends) {
        return ends == core::Ends::Closed ? 2 * n : 2 * n - 1;
    };
    GridPlaces out{
        refined(parents.rows, parents.v), refined(parents.columns, parents.u), parents.u, parents.v, {}};
    std::vector<bool> taken(out.rows * out.columns, false);
    if (ancestors.size() != taken.size()) return std::nullopt;
    for (const auto& ancestor : ancestors) {
        const auto place = child_place(ancestor, parents);
        if (!place || taken[place->i * out.columns + place->j]) return std::nullopt;
        taken[place->i * out.columns + place->j] = true;
        out.of_vertex.push_back(*place);
    }
    return out;
}

}  // namespace loopcheck::compare

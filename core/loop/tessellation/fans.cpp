#include "core/loop/tessellation/fans.h"

#include <algorithm>
#include <numeric>

namespace loopcheck::core {

Fans::Fans(std::size_t vertices, std::span<const Triangle> triangles)
    : triangles_(triangles), offsets_(vertices + 1, 0), members_(3 * triangles.size()) {
    for (const Triangle& t : triangles)
        for (const Index v : t) ++offsets_[v + std::size_t{1}];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const Index v : triangles[i]) members_[next[v]++] = static_cast<Index>(i);
}

std::vector<Index> Fans::star(Index t) const {
    std::vector<Index> out;
    for (const Index v : triangles_[t]) out.insert(out.end(), at(v).begin(), at(v).end());
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

bool Fans::is_closed(Index v) const {
    std::vector<Index> neighbours;
    for (const Index t : at(v))
        for (const Index w : triangles_[t])
            if (w != v) neighbours.push_back(w);
    std::sort(neighbours.begin(), neighbours.end());
    for (std::size_t i = 0; i < neighbours.size(); i += 2)
        if (neighbours[i] != neighbours[i + 1] || (i > 0 && neighbours[i] == neighbours[i - 1])) return false;
    return true;
}

}  // namespace loopcheck::core

#include "core/mesh/mesh_data.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace loopcheck::core {
namespace {

/// The number of faces that a face of that many corners becomes.
Index pieces(std::size_t corners) {
    return corners > 3 ? static_cast<Index>(corners) - 2 : 1;
}

/// The first new face of every old face; one entry more, the number of new faces.
std::vector<std::int64_t> first_pieces(const MeshData& data) {
    std::vector<std::int64_t> first{0};
    for_each_face(data, [&](std::size_t, std::span<const Index> corners) {
        first.push_back(first.back() + pieces(corners.size()));
    });
    return first;
}

/// The holes in the numbers of the new faces.  An index past the last old face goes past the last new one.
std::vector<Index> map_holes(const MeshData& data, std::span<const std::int64_t> first) {
    constexpr std::int64_t kLast = std::numeric_limits<Index>::max();
    const auto faces = static_cast<std::int64_t>(data.face_sizes.size());
    std::vector<Index> holes;
    for (const Index hole : data.holes) {
        if (hole < 0)
            holes.push_back(hole);
        else if (hole >= faces)
            holes.push_back(static_cast<Index>(std::min(kLast, first.back() + (hole - faces))));
        else
            for (std::int64_t f = first[hole]; f < first[hole + 1]; ++f)
                holes.push_back(static_cast<Index>(f));
    }
    return holes;
}

}  // namespace

bool sizes_match(const MeshData& data) {
    std::size_t corners = 0;
    for (const Index size : data.face_sizes) {
        if (size < 0) return false;
        corners += static_cast<std::size_t>(size);
    }
    return corners == data.face_corners.size();
}

Triangulated triangulate(const MeshData& data) {
    Triangulated result;
    if (!sizes_match(data)) {
        result.data = data;
        result.polygon_of.resize(data.face_sizes.size());
        std::iota(result.polygon_of.begin(), result.polygon_of.end(), 0);
        return result;
    }
    result.data.positions = data.positions;
    result.data.creases = data.creases;
    result.data.corners = data.corners;
    result.data.holes = map_holes(data, first_pieces(data));
    for_each_face(data, [&](std::size_t f, std::span<const Index> corners) {
        const auto face = static_cast<Index>(f);
        if (corners.size() <= 3) {
            result.data.add_face(corners);
            result.polygon_of.push_back(face);
            return;
        }
        ++result.split;
        for (std::size_t i = 2; i < corners.size(); ++i) {
            result.data.add_face(Triangle{corners[0], corners[i - 1], corners[i]});
            result.polygon_of.push_back(face);
        }
    });
    return result;
}

}  // namespace loopcheck::core

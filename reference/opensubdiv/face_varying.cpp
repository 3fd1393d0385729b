#include "reference/opensubdiv/face_varying.h"

#include <opensubdiv/far/primvarRefiner.h>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

using namespace internal;
using core::Index;

// What PrimvarRefinerReal asks of a value; remembers whether it was asked.
struct Probe {
    bool written = false;

    void Clear() { written = true; }
    void AddWithWeight(const Probe&, double) { written = true; }
};

// The values it reads: none is kept, for where the wrong values are left alone, wrong indices may be read.
struct Source {
    Probe probe;

    const Probe& operator[](Index) const { return probe; }
};

std::optional<core::Error> check_values(const core::TriangleMesh& mesh, FaceVaryingTopology values) {
    if (values.indices.size() != mesh.topology().triangles.size())
        return core::Error{core::ErrorCode::IndexOutOfRange,
                           fmt::format("There are {} faces and values at the corners of {}.",
                                       mesh.face_count(), values.indices.size())};
    std::vector<Index> vertex_of(values.count, core::kNone);
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (int i = 0; i < 3; ++i) {
            const Index value = values.indices[f][i], vertex = mesh.topology().triangles[f][i];
            const core::Place face{core::Place::Kind::Face, f};
            if (value < 0 || value >= values.count)
                return core::Error{core::ErrorCode::IndexOutOfRange,
                                   fmt::format("Value {} does not exist.", value), face};
            if (vertex_of[value] != core::kNone && vertex_of[value] != vertex)
                return core::Error{
                    core::ErrorCode::RepeatedVertex,
                    fmt::format("Value {} is at vertices {} and {}.", value, vertex_of[value], vertex), face};
            vertex_of[value] = vertex;
        }
    for (Index value = 0; value < values.count; ++value)
        if (vertex_of[value] == core::kNone)
            return core::Error{core::ErrorCode::IndexOutOfRange,
                               fmt::format("Value {} is at no corner.", value)};
    return std::nullopt;
}

}  // namespace

core::Result<UnwrittenValues> opensubdiv_unwritten_limit_values(const core::TriangleMesh& mesh,
                                                                const core::SchemeOptions& options,
                                                                std::span<const core::Triangle> value_indices,
                                                                int value_count, int levels) {
    const FaceVaryingTopology values{value_indices, value_count};
    if (auto error = check_supported(mesh, options, levels)) return tl::unexpected(*error);
    if (auto error = check_values(mesh, values)) return tl::unexpected(*error);
    return contained([&]() -> core::Result<UnwrittenValues> {
        const auto base = make_refiner(mesh, options, values);
        if (!base) return tl::unexpected(base.error());
        const auto refiner = refined_uniformly(**base, levels);
        if (!refiner) return tl::unexpected(refiner.error());

        const int count = (*refiner)->GetLevel(levels).GetNumFVarValues();
        std::vector<Probe> limit(count);
        Far::PrimvarRefinerReal<double>(**refiner).LimitFaceVarying(Source{}, limit);
        if (!caught_messages().empty()) return failed(caught_messages());
        UnwrittenValues out{count, {}};
        for (Index value = 0; value < count; ++value)
            if (!limit[value].written) out.unwritten.push_back(value);
        return out;
    });
}

}  // namespace loopcheck::reference

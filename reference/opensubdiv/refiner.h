// What the adapters to OpenSubdiv share.  Internal to reference/opensubdiv: only its sources include it.
#pragma once

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"
#include "reference/opensubdiv/value.h"

namespace loopcheck::reference::internal {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
using RefinerPtr = std::unique_ptr<Far::TopologyRefiner>;

/// Unsupported where OpenSubdiv has no way to refine the mesh so; else nothing.
std::optional<core::Error> check_supported(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           int levels);

/// SubjectFailed with this reason.
tl::unexpected<core::Error> failed(std::string_view why);

/// Begins to collect, on this thread, what OpenSubdiv says instead of letting it print.
void catch_messages();

/// What it said since.
const std::string& caught_messages();

/// Runs work(), which returns a Result, with messages caught; an exception becomes SubjectFailed.
template <class Work>
std::invoke_result_t<Work> contained(Work work) {
    catch_messages();
    try {
        return work();
    } catch (const std::exception& e) {
        return failed(e.what());
    }
}

/// An unrefined refiner of a mesh described to OpenSubdiv, which checks its topology.
///
/// Errors   SubjectFailed.
core::Result<RefinerPtr> create_refiner(const Far::TopologyDescriptor& descriptor, Sdc::SchemeType scheme,
                                        const core::SchemeOptions& options);

/// Values at the corners of faces: the three of each face, of `count` in all.
struct FaceVaryingTopology {
    std::span<const core::Triangle> indices;
    int count = 0;
};

/// The mesh as an unrefined refiner, with a channel of face-varying values, interpolated smoothly up to their
/// seams, where there is one.
///
/// Errors   SubjectFailed.
core::Result<RefinerPtr> make_refiner(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                      std::optional<FaceVaryingTopology> values = std::nullopt);

/// A refiner of the same control mesh, refined to exactly this level with the full topology of every level.
/// The control mesh stays with `base`, which must live as long.
///
/// Errors   SubjectFailed.
core::Result<RefinerPtr> refined_uniformly(const Far::TopologyRefiner& base, int levels);

/// The control positions, rounded to Real.
template <class Real>
std::vector<Value<Real>> control_values(std::span<const glm::dvec3> positions) {
    std::vector<Value<Real>> out;
    out.reserve(positions.size());
    for (const auto& p : positions)
        out.push_back({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)});
    return out;
}

/// Values that are about to be written: grown without touching them, and used again.
template <class Real>
class Buffer {
  public:
    Value<Real>* room_for(std::size_t size) {
        if (size > size_) values_ = std::make_unique_for_overwrite<Value<Real>[]>(size_ = size);
        return values_.get();
    }
    const Value<Real>* data() const { return values_.get(); }

  private:
    std::unique_ptr<Value<Real>[]> values_;
    std::size_t size_ = 0;
};

template <class Real>
std::vector<glm::dvec3> to_positions(std::span<const Value<Real>> values) {
    std::vector<glm::dvec3> out;
    out.reserve(values.size());
    for (const auto& v : values) out.emplace_back(v.x, v.y, v.z);
    return out;
}

template <class Real>
std::vector<glm::dvec3> to_positions(const std::vector<Value<Real>>& values) {
    return to_positions(std::span<const Value<Real>>(values));
}

/// Limit() of the last level of a refiner, whose values these are.
template <class Real>
core::LimitLevel limit_of_last_level(const Far::PrimvarRefinerReal<Real>& primvars,
                                     const std::vector<Value<Real>>& values) {
    std::vector<Value<Real>> position(values.size()), tangent1(values.size()), tangent2(values.size());
    primvars.Limit(values, position, tangent1, tangent2);
    return {to_positions(position), to_positions(tangent1), to_positions(tangent2)};
}

/// Calls visit(refiner, values, limit) for the levels 0 to `levels`: a refiner whose last level it is, the
/// values there and their limit.  Limit() knows the last level only, so every level is the last of a refiner;
/// the values of the level before are those of the refiner before.
///
/// Errors   SubjectFailed; whatever OpenSubdiv says is one.
template <class Real, class Visit>
std::optional<core::Error> visit_levels(std::span<const glm::dvec3> positions,
                                        const Far::TopologyRefiner& base, int levels, Visit visit) {
    auto values = control_values<Real>(positions);
    for (int l = 0; l <= levels; ++l) {
        const auto refiner = refined_uniformly(base, l);
        if (!refiner) return refiner.error();
        const Far::PrimvarRefinerReal<Real> primvars(**refiner);
        if (l > 0) {
            std::vector<Value<Real>> refined((*refiner)->GetLevel(l).GetNumVertices());
            primvars.Interpolate(l, values, refined);
            values = std::move(refined);
        }
        core::LimitLevel limit = limit_of_last_level(primvars, values);
        if (!caught_messages().empty()) return failed(caught_messages()).value();
        visit(**refiner, values, std::move(limit));
    }
    return std::nullopt;
}

}  // namespace loopcheck::reference::internal

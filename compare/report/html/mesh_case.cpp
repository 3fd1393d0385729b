#include "compare/report/html/mesh_case.h"

#include <algorithm>
#include <limits>

#include "compare/limit/words.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

// Appends unless an earlier comparison of the same subject did.
template <class Value>
void put(std::vector<Value>& list, core::Index v, const Value& value) {
    if (list.size() == static_cast<std::size_t>(v)) list.push_back(value);
}

bool is_in_order(const std::vector<std::uint32_t>& order) {
    for (std::size_t v = 0; v < order.size(); ++v)
        if (order[v] != v) return false;
    return true;
}

}  // namespace

void MeshCase::Numbers::add(const VertexRecord& r, double unit) {
    subject_error.push_back(to_float(r.subject_error / unit));
    reference_error.push_back(to_float(r.reference_error / unit));
    bound.push_back(to_float(r.bound / unit));
    bound_use.push_back(to_float(r.bound_use));
}

std::size_t MeshCase::index_of(const std::string& subject, std::optional<std::size_t> compared_with) {
    const auto found =
        std::find_if(made_.begin(), made_.end(), [&](const Made& made) { return made.subject == subject; });
    const auto index = static_cast<std::size_t>(found - made_.begin());
    if (found == made_.end())
        made_.push_back({subject, compared_with, std::vector<MadeLevel>(static_cast<std::size_t>(shown_))});
    return index;
}

std::uint8_t MeshCase::index_of_deviation(std::string_view name) {
    const auto found = std::find(deviations_.begin(), deviations_.end(), name);
    const auto index = static_cast<std::uint8_t>(found - deviations_.begin() + 1);
    if (found == deviations_.end()) deviations_.emplace_back(name);
    return index;
}

void MeshCase::begin(const Subject& subject, const Subject& reference) {
    exact_.resize(static_cast<std::size_t>(shown_));
    Pair& pair = pairs_.emplace_back();
    pair.unit = error_unit(mesh_.largest_coordinate(), subject.precision, reference.precision);
    pair.subject = index_of(subject.name, std::nullopt);
    pair.reference = index_of(reference.name, pair.subject);
    pair.levels.resize(static_cast<std::size_t>(shown_));
}

void MeshCase::add(const VertexRecord& r) {
    if (r.level >= shown_) return;
    Pair& pair = pairs_.back();
    pair.levels[r.level].refinement.add(r, pair.unit);
    const auto keep = [&](MadeLevel& made, const glm::dvec3& position, core::Index own) {
        put(made.positions, r.vertex, position);
        put(made.order, r.vertex, static_cast<std::uint32_t>(own));
    };
    keep(made_[pair.subject].levels[r.level], r.subject, r.subject_vertex);
    keep(made_[pair.reference].levels[r.level], r.reference, r.reference_vertex);
}

void MeshCase::add(const LimitRecord& record) {
    const VertexRecord& r = record.position;
    const NormalRecord& n = record.normal;
    if (r.level >= shown_) return;
    Pair& pair = pairs_.back();
    LevelNumbers& numbers = pair.levels[r.level];
    numbers.limits.add(r, pair.unit);
    const bool compared = n.status == NormalStatus::Compared;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    numbers.normal.push_back(to_float(compared ? in_degrees(n.error) : kNone));
    numbers.normal_bound.push_back(to_float(compared ? in_degrees(n.bound) : kNone));
    numbers.deviation.push_back(record.deviation.empty() ? 0 : index_of_deviation(record.deviation));
    const auto keep = [&](MadeLevel& made, const glm::dvec3& position, const glm::dvec3& normal) {
        put(made.limits, r.vertex, position);
        put(made.normals, r.vertex, normal);
    };
    keep(made_[pair.subject].levels[r.level], r.subject, n.subject);
    keep(made_[pair.reference].levels[r.level], r.reference, n.reference);
    put(exact_[r.level].limits, r.vertex, r.exact);
    put(exact_[r.level].normals, r.vertex, n.exact);
}

void MeshCase::end(const Comparison& comparison, const std::optional<LimitComparison>& limits) {
    Pair& pair = pairs_.back();
    if (comparison.verdict == Verdict::KnownDeviation)
        pair.deviation = index_of_deviation(comparison.deviation);
    pair.comparison = json_of(comparison, limits, Detail::Classes);
    for (const char* said_of_the_case : {"boundary", "creasing", "weights"})
        pair.comparison.erase(said_of_the_case);
}

Json MeshCase::positions(ChunkWriter& chunk, std::size_t level, ArrayRef exact) const {
    Json out = Json::array();
    std::vector<ArrayRef> refs;  // as in `made_`
    for (const Made& made : made_) {
        const MadeLevel& here = made.levels[level];
        refs.push_back(exact);
        if (here.positions.empty()) continue;
        refs.back() = chunk.add(here.positions, made.compared_with ? refs[*made.compared_with] : exact);
        Json entry{{"subject", made.subject}, {"positions", refs.back()}};
        if (!is_in_order(here.order)) entry["order"] = chunk.add(here.order);
        out.push_back(std::move(entry));
    }
    return out;
}

Json MeshCase::limits(ChunkWriter& chunk, std::size_t level, ArrayRef exact_positions) const {
    const ArrayRef exact = chunk.add(exact_[level].limits, exact_positions);
    const ArrayRef exact_normals = chunk.add(exact_[level].normals);
    Json out{{"exact", exact}, {"exact_normals", exact_normals}, {"positions", Json::array()}};
    std::vector<std::pair<ArrayRef, ArrayRef>> refs;
    for (const Made& made : made_) {
        const MadeLevel& here = made.levels[level];
        refs.emplace_back(exact, exact_normals);
        if (here.limits.empty()) continue;
        const auto base = made.compared_with ? refs[*made.compared_with] : refs.back();
        refs.back() = {chunk.add(here.limits, base.first), chunk.add(here.normals, base.second)};
        out["positions"].push_back(
            {{"subject", made.subject}, {"positions", refs.back().first}, {"normals", refs.back().second}});
    }
    return out;
}

Json MeshCase::Numbers::put_into(ChunkWriter& chunk, const Json& base) const {
    const auto put_in = [&](const char* name, const std::vector<float>& values) {
        return chunk.add(values,
                         base.contains(name) ? std::optional(base[name].get<ArrayRef>()) : std::nullopt);
    };
    const ArrayRef subject = put_in("subject_error", subject_error);
    return {{"subject_error", subject},
            {"reference_error", chunk.add(reference_error, subject)},
            {"bound", put_in("bound", bound)},
            {"bound_use", put_in("bound_use", bound_use)}};
}

Json MeshCase::numbers(ChunkWriter& chunk, std::size_t level) const {
    Json out = Json::array();
    std::vector<std::size_t> before;  // pairs that have numbers
    for (const Pair& pair : pairs_) {
        const LevelNumbers& here = pair.levels[level];
        if (here.refinement.bound.empty()) {
            out.push_back(nullptr);
            continue;
        }
        // An earlier comparison of the same subject has the same errors of it and, in one precision, the same
        // bounds.
        const auto same = std::find_if(before.begin(), before.end(),
                                       [&](std::size_t i) { return pairs_[i].subject == pair.subject; });
        const Json base = same != before.end() ? out[*same] : Json::object();
        Json entry = here.refinement.put_into(chunk, base);
        if (!here.limits.bound.empty()) {
            entry["limits"] = here.limits.put_into(chunk, base.value("limits", Json::object()));
            entry["limits"]["normal"] = chunk.add(here.normal);
            entry["limits"]["normal_bound"] = chunk.add(here.normal_bound);
            entry["limits"]["deviation"] = chunk.add(here.deviation);
        }
        if (pair.deviation != 0) {
            std::vector<std::uint8_t> shows;
            shows.reserve(here.refinement.bound_use.size());
            for (const float use : here.refinement.bound_use) shows.push_back(use <= 1 ? 0 : pair.deviation);
            entry["deviation"] = chunk.add(shows);
        }
        before.push_back(out.size());
        out.push_back(std::move(entry));
    }
    return out;
}

std::optional<std::string> MeshCase::chunk(const Witness& witness) && {
    const bool compared = std::any_of(pairs_.begin(), pairs_.end(),
                                      [](const Pair& pair) { return !pair.comparison["levels"].empty(); });
    if (!compared) return std::nullopt;
    ChunkWriter chunk;
    LevelWriter writer(chunk, witness, shown_);
    Json levels = Json::array();
    for (int l = 0; l < shown_; ++l) {
        const auto at = static_cast<std::size_t>(l);
        Json level = writer.add(l);
        const auto exact = level["exact"].get<ArrayRef>();
        level["positions"] = positions(chunk, at, exact);
        if (!exact_[at].limits.empty()) level["limits"] = limits(chunk, at, exact);
        level["comparisons"] = numbers(chunk, at);
        levels.push_back(std::move(level));
    }
    Json header{{"kind", "mesh"}, {"comparisons", Json::array()}, {"surfaces", Json::array()}};
    for (Pair& pair : pairs_) header["comparisons"].push_back(std::move(pair.comparison));
    std::move(writer).finish(header);
    header["deviations"] = deviations_;
    header["face_classes"] = Json::array();
    header["levels"] = std::move(levels);
    return std::move(chunk).text(std::move(header));
}

}  // namespace loopcheck::compare

#include "compare/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace loopcheck::compare {
namespace {

using core::Ancestor;
using core::Index;
using core::kNone;
using core::RefinedLevel;
using core::Triangle;

// A cyclic triple, smallest vertex first, and by how many corners it was turned to get there.
struct Cyclic {
    Triangle triangle;
    int turned = 0;
};

Cyclic cyclic(const Triangle& t) {
    const int first = static_cast<int>(std::min_element(t.begin(), t.end()) - t.begin());
    return {{t[first], t[(first + 1) % 3], t[(first + 2) % 3]}, first};
}

// The pairing of one level.
struct LevelMatch {
    std::vector<Index> vertex_of;      // our vertex -> theirs
    std::vector<Index> our_vertex_of;  // their vertex -> ours
    std::vector<Index> our_side_of;    // their side 3 f + i -> ours
};

class Matcher {
  public:
    Matcher(const core::Topology& ours, const RefinedLevel& theirs, int level)
        : ours_(ours), theirs_(theirs), level_(level) {}

    core::Result<LevelMatch> run(const WitnessLevel* parent, const LevelMatch* parent_match) {
        if (auto error = check_counts()) return tl::unexpected(*error);
        if (parent == nullptr) {
            out_.vertex_of.resize(theirs_.positions.size());
            std::iota(out_.vertex_of.begin(), out_.vertex_of.end(), Index{0});
            out_.our_vertex_of = out_.vertex_of;
        } else if (auto error = pair_vertices(parent->scheme.topology, *parent_match)) {
            return tl::unexpected(*error);
        }
        if (auto error = pair_faces()) return tl::unexpected(*error);
        return std::move(out_);
    }

  private:
    core::Error broken(std::string sentence) const {
        return {core::ErrorCode::SubjectFailed, fmt::format("At level {} {}", level_, sentence)};
    }

    std::optional<core::Error> check_counts() const {
        const auto vertices = static_cast<Index>(theirs_.positions.size());
        if (vertices != ours_.vertex_count || theirs_.triangles.size() != ours_.triangles.size())
            return broken(fmt::format("there are {} vertices and {} faces where {} and {} must be.", vertices,
                                      theirs_.triangles.size(), ours_.vertex_count, ours_.triangles.size()));
        if (level_ > 0 && theirs_.ancestors.size() != theirs_.positions.size())
            return broken(
                fmt::format("{} vertices have ancestors, of {}.", theirs_.ancestors.size(), vertices));
        if (!theirs_.tags.empty() && theirs_.tags.size() != theirs_.positions.size())
            return broken(fmt::format("{} vertices have tags, of {}.", theirs_.tags.size(), vertices));
        return std::nullopt;
    }

    std::optional<core::Error> pair_vertices(const core::Topology& parent, const LevelMatch& parent_match) {
        out_.vertex_of.assign(theirs_.positions.size(), kNone);
        out_.our_vertex_of.assign(theirs_.positions.size(), kNone);
        for (std::size_t s = 0; s < theirs_.ancestors.size(); ++s) {
            const Ancestor& ancestor = theirs_.ancestors[s];
            const auto& table = ancestor.kind == Ancestor::Kind::Vertex ? parent_match.our_vertex_of
                                                                        : parent_match.our_side_of;
            if (ancestor.index < 0 || ancestor.index >= static_cast<Index>(table.size()))
                return broken(fmt::format("vertex {} names a parent that does not exist.", s));
            const Index ours = table[ancestor.index];
            const Index v = ancestor.kind == Ancestor::Kind::Vertex
                                ? ours
                                : parent.vertex_count + parent.face_edges[ours / 3][ours % 3];
            if (out_.vertex_of[v] != kNone)
                return broken(fmt::format("vertices {} and {} have the same parent.", out_.vertex_of[v], s));
            out_.vertex_of[v] = static_cast<Index>(s);
            out_.our_vertex_of[s] = v;
        }
        return std::nullopt;  // as many as there are, none twice: one to one
    }

    // Pairs faces as cyclic triples of our vertices.  A triple is unique: two faces with the same three
    // vertices, as in two triangles glued along all edges, have opposite windings.
    std::optional<core::Error> pair_faces() {
        std::vector<std::uint8_t> taken(ours_.triangles.size(), 0);
        out_.our_side_of.resize(3 * ours_.triangles.size());
        for (Index g = 0; g < ours_.face_count(); ++g) {
            Triangle mapped;
            for (int i = 0; i < 3; ++i) {
                const Index s = theirs_.triangles[g][i];
                if (s < 0 || s >= ours_.vertex_count)
                    return broken(fmt::format("face {} names vertex {}, which does not exist.", g, s));
                mapped[i] = out_.our_vertex_of[s];
            }
            const auto found = find_face(g, mapped);
            if (!found || taken[found->face])
                return broken(fmt::format(
                    "face {} joins vertices {}, {} and {}, which {}.", g, theirs_.triangles[g][0],
                    theirs_.triangles[g][1], theirs_.triangles[g][2],
                    found ? "another face joins already" : "no face of the right subdivision joins"));
            taken[found->face] = 1;
            for (int i = 0; i < 3; ++i)
                out_.our_side_of[3 * g + i] = 3 * found->face + (i + found->turned) % 3;
        }
        return std::nullopt;
    }

    struct Found {
        Index face;
        int turned;  // their corner i is our corner i + turned
    };

    // Our face with these corners: the one of the same number almost always, else by search.
    std::optional<Found> find_face(Index same_number, const Triangle& corners) {
        if (ours_.triangles[same_number] == corners) return Found{same_number, 0};
        if (sorted_.empty()) {
            for (Index f = 0; f < ours_.face_count(); ++f) sorted_.push_back({cyclic(ours_.triangles[f]), f});
            std::sort(sorted_.begin(), sorted_.end());
        }
        const Cyclic wanted = cyclic(corners);
        const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), Entry{wanted, 0});
        if (found == sorted_.end() || found->cyclic.triangle != wanted.triangle) return std::nullopt;
        return Found{found->face, (found->cyclic.turned - wanted.turned + 3) % 3};
    }

    struct Entry {
        Cyclic cyclic;
        Index face;
        bool operator<(const Entry& other) const { return cyclic.triangle < other.cyclic.triangle; }
    };

    const core::Topology& ours_;
    const RefinedLevel& theirs_;
    int level_;
    LevelMatch out_;
    std::vector<Entry> sorted_;  // our faces by cyclic triple, made when first needed
};

}  // namespace

core::Result<Match> match(const Witness& witness, const core::Refinement& refinement) {
    if (refinement.levels.size() != witness.levels.size())
        return core::fail(
            core::ErrorCode::SubjectFailed,
            fmt::format("There are {} levels where {} were asked for, the control mesh included.",
                        refinement.levels.size(), witness.levels.size()));
    Match out;
    LevelMatch previous;
    for (std::size_t l = 0; l < witness.levels.size(); ++l) {
        Matcher matcher(witness.levels[l].scheme.topology, refinement.levels[l], static_cast<int>(l));
        auto level = l == 0 ? matcher.run(nullptr, nullptr) : matcher.run(&witness.levels[l - 1], &previous);
        if (!level) return tl::unexpected(level.error());
        previous = std::move(*level);
        out.vertex_of.push_back(previous.vertex_of);
    }
    return out;
}

}  // namespace loopcheck::compare

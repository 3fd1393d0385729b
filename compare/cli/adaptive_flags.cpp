#include "compare/cli/adaptive_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "compare/adaptive/adaptive_comparison.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

// "0-99,150": the numbers, or nothing where the text is no such list or a number is not below `count`.
std::optional<std::vector<core::Index>> parse_list(std::string_view text, core::Index count) {
    std::vector<bool> is_listed(static_cast<std::size_t>(count));
    for (bool more = true; more;) {
        const std::size_t comma = text.find(',');
        const std::string_view item = text.substr(0, comma);
        const std::size_t dash = item.find('-');
        const auto first = core::parse_integer(item.substr(0, dash));
        const auto last = dash == std::string_view::npos ? first : core::parse_integer(item.substr(dash + 1));
        if (!first || !last || *first < 0 || *first > *last || *last >= count) return std::nullopt;
        std::fill(is_listed.begin() + *first, is_listed.begin() + *last + 1, true);
        more = comma != std::string_view::npos;
        if (more) text.remove_prefix(comma + 1);
    }
    std::vector<core::Index> out;
    for (core::Index f = 0; f < count; ++f)
        if (is_listed[static_cast<std::size_t>(f)]) out.push_back(f);
    return out;
}

}  // namespace

void AdaptiveFlags::add_to(CLI::App& command) {
    auto* adaptive =
        command.add_flag("--adaptive", on, "split only some faces: those that --split or --faces say");
    auto* angle = command
                      .add_option("--angle", degrees,
                                  "the largest angle to the neighbours' normals that is smooth, in degrees")
                      ->capture_default_str()
                      ->check(check_degrees)
                      ->needs(adaptive);
    auto* with = command
                     .add_option("--neighbours", neighbours,
                                 "edge, vertex or first-vertex-ring: the faces a normal is compared with")
                     ->capture_default_str()
                     ->check(CLI::IsMember({"edge", "vertex", "first-vertex-ring"}))
                     ->needs(adaptive);
    auto* which =
        command
            .add_option("--split", split,
                        "smooth: faces whose angle is at most that, what is sharp stays; bent: the others, "
                        "what is flat stays")
            ->capture_default_str()
            ->check(CLI::IsMember({"smooth", "bent"}))
            ->needs(adaptive);
    command.add_option("--faces", faces, "split these faces of the model and their parts instead: 0-99,150")
        ->needs(adaptive)
        ->excludes(which)
        ->excludes(angle)
        ->excludes(with);
}

std::optional<core::Criterion> AdaptiveFlags::criterion(const Context& context,
                                                        const core::TriangleMesh& mesh) const {
    if (faces) {
        auto list = parse_list(*faces, mesh.face_count());
        if (list) return core::where_listed(std::move(*list));
        context.err << fmt::format("--faces: '{}' is not a list such as 0-99,150 of faces from 0 to {}.\n",
                                   *faces, mesh.face_count() - 1);
        return std::nullopt;
    }
    const double threshold = glm::radians(degrees);
    const auto compared_with = core::parse_neighbours(neighbours).value();
    return split == "smooth" ? core::where_smooth(threshold, compared_with)
                             : core::where_bent(threshold, compared_with);
}

std::string AdaptiveFlags::in_words() const {
    constexpr std::size_t kShown = 60;
    if (faces)
        return fmt::format("adaptive, faces {}{} and their parts are subdividable", faces->substr(0, kShown),
                           faces->size() > kShown ? "..." : "");
    return fmt::format(
        "adaptive, faces are split where their normal is {} {:.6g} degrees from {} ({} neighbours)",
        split == "smooth" ? "at most" : "more than", degrees + 0.0,  // -0 is 0
        split == "smooth" ? "that of every neighbour" : "that of a neighbour", neighbours);
}

core::Result<core::AdaptiveRefinement> refine_adaptively(const core::TriangleMesh& mesh,
                                                         const core::SchemeOptions& options,
                                                         const core::Criterion& criterion,
                                                         core::Precision precision, int levels,
                                                         double bytes) {
    const double most_faces = bytes / kAdaptiveBytesPerFace;
    return precision == core::Precision::Float
               ? core::refine_adaptively<float>(mesh, options, criterion, levels, most_faces)
               : core::refine_adaptively<double>(mesh, options, criterion, levels, most_faces);
}

}  // namespace loopcheck::compare

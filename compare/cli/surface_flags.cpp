#include "compare/cli/surface_flags.h"

namespace loopcheck::compare {

void WayFlag::add_to(CLI::App& command) {
    std::vector<std::string> names{"all"};
    for (const SurfaceWay& way : surface_ways()) names.emplace_back(way.name);
    command
        .add_option(
            "--method", method,
            "OpenSubdiv's way to the surface: bfr, patch-gregory, patch-box, patch-linear (PatchTable by "
            "end cap, sharp features exact), patch-default (PatchTable as it comes), or all")
        ->capture_default_str()
        ->check(CLI::IsMember(names));
}

std::vector<SurfaceWay> WayFlag::ways() const {
    if (const SurfaceWay* way = find_way(method)) return {*way};
    return {surface_ways().begin(), surface_ways().end()};
}

}  // namespace loopcheck::compare

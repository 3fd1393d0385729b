#include "compare/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace loopcheck::compare {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

double meminfo_available() {
    std::ifstream in("/proc/meminfo");
    std::string key, unit;
    for (double value = 0; in >> key >> value; std::getline(in, unit))
        if (key == "MemAvailable:") return value * 1024;
    return kUnlimited;
}

double read_number(const std::string& path) {
    std::ifstream in(path);
    double value = 0;
    return in >> value ? value : kUnlimited;  // "max" is no number
}

double control_group_left() {
    std::ifstream in("/proc/self/cgroup");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("0::")) {
            const std::string folder = "/sys/fs/cgroup" + line.substr(3);
            const double limit = read_number(folder + "/memory.max");
            return limit == kUnlimited ? kUnlimited : limit - read_number(folder + "/memory.current");
        }
    return kUnlimited;
}

double address_space_left() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
    return static_cast<double>(limit.rlim_cur);
}

std::string in_gib(double bytes) {
    return fmt::format("{:.3g} GiB", bytes / (1024.0 * 1024 * 1024));
}

}  // namespace

LevelSize level_size(const core::TriangleMesh& mesh, int level) {
    LevelSize size{static_cast<double>(mesh.vertex_count()),
                   static_cast<double>(mesh.topology().edge_count()), static_cast<double>(mesh.face_count())};
    for (int l = 0; l < level; ++l)
        size = {size.vertices + size.edges, 2 * size.edges + 3 * size.faces, 4 * size.faces};
    return size;
}

double available_memory() {
    return std::max(0.0, std::min({meminfo_available(), control_group_left(), address_space_left()}));
}

std::optional<core::Error> check_memory(std::string_view what, double bytes, double limit) {
    if (bytes <= limit) return std::nullopt;
    return core::Error{core::ErrorCode::OutOfMemory,
                       fmt::format("{} and needs about {}; {} may be used (--memory sets the limit).", what,
                                   in_gib(bytes), in_gib(limit))};
}

std::optional<core::Error> check_memory(const core::TriangleMesh& mesh, int levels, double bytes_per_vertex,
                                        double limit) {
    const LevelSize size = level_size(mesh, levels);
    if (3 * size.faces > std::numeric_limits<core::Index>::max())
        return core::Error{
            core::ErrorCode::TooLarge,
            fmt::format("Level {} would have {:.3g} faces; at most 2^31 - 1 corners can be numbered.", levels,
                        size.faces)};
    return check_memory(
        fmt::format("Level {} has {:.0f} vertices and {:.0f} faces", levels, size.vertices, size.faces),
        size.vertices * bytes_per_vertex, limit);
}

}  // namespace loopcheck::compare

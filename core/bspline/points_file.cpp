#include "core/bspline/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/number.h"
#include "core/mesh/io/text_reader.h"

namespace loopcheck::core {
namespace {

// The fields of a line: between separators where there are any, which may not be mixed, else between blanks.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> out;
    const std::size_t separator = line.find_first_of(",;");
    if (separator == std::string_view::npos) {
        for (Words words(line); !words.empty();) out.push_back(words.next());
        return out;
    }
    const char mark = line[separator];
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(mark, begin), line.size());
        out.push_back(Words(line.substr(begin, end - begin)).rest());
        begin = end + 1;
    }
    return out;
}

bool names_columns(const std::vector<std::string_view>& fields) {
    return fields.size() <= 3 && std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
               const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
               return !field.empty() && letter(field.front()) && !parse_double(field);
           });
}

constexpr std::size_t kShown = 40;
std::string shown(std::string_view text) {
    return text.size() <= kShown ? std::string(text) : std::string(text.substr(0, kShown)) + "...";
}

}  // namespace

Result<PointsFile> parse_points(std::string_view bytes) {
    PointsFile out;
    LineReader lines(bytes, {.comments = true});
    for (bool first = true; lines.next_with_words(); first = false) {
        const auto fields = fields_of(lines.text());
        const Place place{Place::Kind::Line, lines.number()};
        if (first && names_columns(fields)) continue;
        if (out.points.empty()) out.dimension = static_cast<int>(fields.size());
        if (fields.size() != 2 && fields.size() != 3)
            return fail(ErrorCode::BadSyntax,
                        fmt::format("A point has 2 or 3 coordinates; this line has {}.", fields.size()),
                        place);
        if (static_cast<int>(fields.size()) != out.dimension)
            return fail(ErrorCode::BadSyntax,
                        fmt::format("This point has {} coordinates, those before have {}.", fields.size(),
                                    out.dimension),
                        place);
        glm::dvec3 point(0);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (fields[i].empty())
                return fail(ErrorCode::BadSyntax, "A coordinate is missing beside a separator.", place);
            const auto value = parse_double(fields[i]);
            if (!value)
                return fail(ErrorCode::BadSyntax, fmt::format("'{}' is not a number.", shown(fields[i])),
                            place);
            if (!std::isfinite(*value))
                return fail(ErrorCode::NotFinite, fmt::format("'{}' is not finite.", shown(fields[i])),
                            place);
            point[static_cast<glm::length_t>(i)] = *value;
        }
        out.points.push_back(point);
        out.lines.push_back(lines.number());
    }
    if (out.points.empty()) return fail(ErrorCode::TooFewPoints, "There is no point in the file.");
    return out;
}

Result<PointsFile> read_points(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_points(*bytes);
}

}  // namespace loopcheck::core

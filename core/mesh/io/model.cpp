#include "core/mesh/io/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/formats.h"
#include "core/mesh/io/number.h"

namespace loopcheck::core {
namespace {

struct Extension {
    std::string_view text;
    FileFormat format;
};
constexpr std::array kExtensions{Extension{".obj", FileFormat::Obj}, Extension{".off", FileFormat::Off},
                                 Extension{".ply", FileFormat::Ply}, Extension{".stl", FileFormat::Stl}};

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool is_vertex(Index index, const MeshData& data) {
    return index >= 0 && static_cast<std::size_t>(index) < data.positions.size();
}
bool is_face(Index index, const MeshData& data) {
    return index >= 0 && static_cast<std::size_t>(index) < data.face_sizes.size();
}

Result<void> check_positions(const MeshData& data) {
    for (std::size_t v = 0; v < data.positions.size(); ++v) {
        const glm::dvec3& p = data.positions[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return fail(ErrorCode::NotFinite,
                        fmt::format("The coordinates ({}, {}, {}) are not all finite.", shortest(p.x),
                                    shortest(p.y), shortest(p.z)),
                        {Place::Kind::Vertex, static_cast<Index>(v)});
    }
    return {};
}

Result<void> check_faces(const MeshData& data) {
    if (!sizes_match(data))
        return fail(ErrorCode::IndexOutOfRange,
                    fmt::format("The sizes of the faces do not add up to the {} corners that there are.",
                                data.face_corners.size()));
    Result<void> result;
    for_each_face(data, [&](std::size_t f, std::span<const Index> corners) {
        for (const Index corner : corners)
            if (!is_vertex(corner, data) && result)
                result = fail(ErrorCode::IndexOutOfRange,
                              fmt::format("The face has the vertex {}, but there are {} vertices.", corner,
                                          data.positions.size()),
                              {Place::Kind::Face, static_cast<Index>(f)});
    });
    return result;
}

Result<void> check_sharpness(float sharpness) {
    if (sharpness >= 0) return {};
    return fail(ErrorCode::BadSharpness, fmt::format("A tag has the sharpness {}.", shortest(sharpness)));
}

Result<void> check_tags(const MeshData& data) {
    const auto no_vertex = [&](Index vertex) {
        return fail(ErrorCode::IndexOutOfRange,
                    fmt::format("A tag has the vertex {}, but there are {} vertices.", vertex,
                                data.positions.size()));
    };
    for (const EdgeSharpness& crease : data.creases) {
        for (const Index end : {crease.a, crease.b})
            if (!is_vertex(end, data)) return no_vertex(end);
        if (auto good = check_sharpness(crease.sharpness); !good) return good;
    }
    for (const VertexSharpness& corner : data.corners) {
        if (!is_vertex(corner.vertex, data)) return no_vertex(corner.vertex);
        if (auto good = check_sharpness(corner.sharpness); !good) return good;
    }
    for (const Index hole : data.holes)
        if (!is_face(hole, data))
            return fail(
                ErrorCode::HoleOutOfRange,
                fmt::format("A hole is the face {}, but there are {} faces.", hole, data.face_sizes.size()));
    return {};
}

/// What `parse_model` would refuse to read is not written.
Result<void> check_writable(const MeshData& data) {
    if (auto good = check_positions(data); !good) return good;
    if (auto good = check_faces(data); !good) return good;
    return check_tags(data);
}

}  // namespace

Place Model::locate(Place place) const {
    const std::vector<Index> none;
    const std::vector<Index>& lines = place.kind == Place::Kind::Vertex ? vertex_lines
                                      : place.kind == Place::Kind::Face ? face_lines
                                                                        : none;
    if (place.index < 0 || static_cast<std::size_t>(place.index) >= lines.size()) return place;
    return {Place::Kind::Line, lines[static_cast<std::size_t>(place.index)]};
}

Result<FileFormat> format_of(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    for (const Extension& known : kExtensions)
        if (known.text == extension) return known.format;
    return fail(ErrorCode::UnknownFormat,
                fmt::format("The name {} does not end in .obj, .off, .ply or .stl.", path.string()));
}

Result<Model> read_model(const std::filesystem::path& path) {
    return format_of(path).and_then([&](FileFormat format) {
        return read_file(path).and_then([&](const std::string& bytes) { return parse_model(format, bytes); });
    });
}

Result<Model> parse_model(FileFormat format, std::string_view bytes) {
    switch (format) {
        case FileFormat::Obj:
            return parse_obj(bytes);
        case FileFormat::Off:
            return parse_off(bytes);
        case FileFormat::Ply:
            return parse_ply(bytes);
        case FileFormat::Stl:
            return parse_stl(bytes);
    }
    return fail(ErrorCode::UnknownFormat, "This is no file format.");
}

Result<std::vector<std::string>> write_model(const std::filesystem::path& path, const Model& model,
                                             Encoding encoding) {
    return format_of(path)
        .and_then([&](FileFormat format) { return format_model(format, model, encoding); })
        .and_then([&](const Written& written) {
            return write_file(path, written.bytes).map([&] { return written.warnings; });
        });
}

Result<Written> format_model(FileFormat format, const Model& model, Encoding encoding) {
    if (encoding == Encoding::Binary && (format == FileFormat::Obj || format == FileFormat::Off))
        return fail(ErrorCode::Unsupported, "Only PLY is written in binary; OBJ and OFF are text.");
    if (encoding == Encoding::Binary && format == FileFormat::Stl)
        return fail(ErrorCode::Unsupported,
                    "Binary STL would round the coordinates to float; write it as text.");
    if (auto writable = check_writable(model.data); !writable)
        return tl::unexpected<Error>(std::move(writable.error()));
    switch (format) {
        case FileFormat::Obj:
            return format_obj(model);
        case FileFormat::Off:
            return format_off(model);
        case FileFormat::Ply:
            return format_ply(model, encoding);
        case FileFormat::Stl:
            return format_stl(model);
    }
    return fail(ErrorCode::UnknownFormat, "This is no file format.");
}

}  // namespace loopcheck::core

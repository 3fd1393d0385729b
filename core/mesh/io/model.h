// A mesh file: the mesh, and what else the file says.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/options.h"

namespace loopcheck::core {

/// Everything a file can say.  Only OBJ can say all of it.
struct Model {
    MeshData data;
    std::optional<BoundaryRule> boundary;  ///< `t interpolateboundary`
    std::optional<Creasing> creasing;      ///< `t creasemethod`
    std::string description;               ///< the first comment line (STL: the name of the solid), or empty
    std::vector<std::string> warnings;     ///< what was skipped or read in a particular way, a sentence each
    std::vector<Index> vertex_lines;       ///< line of each vertex in a text file, from 1; else empty
    std::vector<Index> face_lines;         ///< line of each face in a text file, from 1; else empty

    /// The line a vertex or face of `data` was read from, as a Place; the place itself where no line is
    /// known.
    Place locate(Place place) const;
};

enum class FileFormat : std::uint8_t { Obj, Off, Ply, Stl };

/// The format a file name asks for, by its extension in any case.  Errors: UnknownFormat.
Result<FileFormat> format_of(const std::filesystem::path& path);

/// Reads a mesh file.
///
/// A coordinate read from text is the double nearest to what is written (correctly rounded).  Corners of STL
/// with equal coordinates (-0 equals 0) become one vertex, in the order and with the bits of their first use.
///
/// Errors   CannotRead, UnknownFormat, BadSyntax, NotFinite, BadSharpness, TooLarge; IndexOutOfRange and
///          HoleOutOfRange where a face or tag names what the file does not have.  The place is the line; in
///          binary files there is none, and the sentence says the byte.
/// Whether it is a good mesh is for `TriangleMesh::make`.
Result<Model> read_model(const std::filesystem::path& path);

/// The same from memory.
Result<Model> parse_model(FileFormat format, std::string_view bytes);

enum class Encoding : std::uint8_t { Text, Binary };

/// Writes a mesh file: beside the target first, then renamed, so that no half file is ever left there.
///
/// Doubles survive: text carries the shortest digits that read back to the same bits, binary PLY doubles.
/// `Encoding::Binary` is for PLY; binary STL would round to float and is refused (Unsupported).
/// What the format cannot say (tags in OFF, PLY and STL; isolated vertices and shared corners in STL) comes
/// back as warnings, a sentence each.  Whatever is written can be read: what no reader accepts is refused.
///
/// Errors   CannotWrite, UnknownFormat, Unsupported; IndexOutOfRange, HoleOutOfRange, NotFinite and
///          BadSharpness where `read_model` would give them.
Result<std::vector<std::string>> write_model(const std::filesystem::path& path, const Model& model,
                                             Encoding encoding = Encoding::Text);

/// The same into memory.
struct Written {
    std::string bytes;
    std::vector<std::string> warnings;
};
Result<Written> format_model(FileFormat format, const Model& model, Encoding encoding = Encoding::Text);

}  // namespace loopcheck::core

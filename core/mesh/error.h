// Bad data as a value: a code, a sentence and the place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace loopcheck::core {

/// What is wrong.  The name given by `code_name` is stable: scripts and tests may depend on it.
enum class ErrorCode : std::uint8_t {
    CannotRead,           ///< the file cannot be opened or read
    CannotWrite,          ///< the file cannot be written
    UnknownFormat,        ///< no reader or writer goes by this file extension
    BadSyntax,            ///< the file breaks the rules of its format
    NotATriangle,         ///< a face has other than three corners
    IndexOutOfRange,      ///< a face or tag names a vertex that does not exist
    RepeatedVertex,       ///< a face names one vertex twice
    NotFinite,            ///< a coordinate is NaN or infinite
    BadSharpness,         ///< a sharpness is NaN or negative
    NoSuchEdge,           ///< a crease on an edge that does not exist
    HoleOutOfRange,       ///< a hole names a face that does not exist
    EmptyMesh,            ///< no vertices or no faces
    TooLarge,             ///< more than 2^31 - 1 of something
    NonManifoldEdge,      ///< an edge of more than two faces
    NonManifoldVertex,    ///< the faces around a vertex form more than one fan
    InconsistentWinding,  ///< two neighbouring faces run along their edge in the same direction
    DuplicateFace,        ///< two faces with the same three vertices and the same winding
    TooFewPoints,         ///< fewer control points than a curve of this kind needs
    BadKnots,             ///< knots that no continuous curve can have
    OutsideDomain,        ///< a parameter is outside its triangle or curve
    NoLimitSurface,       ///< a face that has no limit surface: a hole, or one at a boundary without rule
    Unsupported,          ///< a subject or a file format has no way to express this
    OutOfMemory,          ///< the work would need more memory than there is
    SubjectFailed,        ///< an implementation under test broke its promise
};

/// The code as it is printed and documented, for instance "repeated-vertex".
std::string_view code_name(ErrorCode code);

/// Where in a mesh, a curve or a file something is.
struct Place {
    enum class Kind : std::uint8_t { None, Line, Vertex, Face, Point };
    Kind kind = Kind::None;
    std::int64_t index = 0;  ///< vertices, faces and points from 0, lines from 1

    bool operator==(const Place&) const = default;
};

/// The place as text, "face 12"; empty where there is none.
std::string to_string(Place place);

/// One thing that is wrong with some data.
struct Error {
    ErrorCode code;
    std::string sentence;  ///< a full sentence, without the place
    Place place = {};
};

/// The error as one line: "face 12: Vertex 7 appears twice. [repeated-vertex]".
std::string to_string(const Error& error);

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning an error from a function that returns a `Result`.
inline tl::unexpected<Error> fail(ErrorCode code, std::string sentence, Place place = {}) {
    return tl::unexpected<Error>(Error{code, std::move(sentence), place});
}

}  // namespace loopcheck::core

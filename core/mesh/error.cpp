#include "core/mesh/error.h"

#include <fmt/format.h>

namespace loopcheck::core {

std::string_view code_name(ErrorCode code) {
    switch (code) {
        case ErrorCode::CannotRead:
            return "cannot-read";
        case ErrorCode::CannotWrite:
            return "cannot-write";
        case ErrorCode::UnknownFormat:
            return "unknown-format";
        case ErrorCode::BadSyntax:
            return "bad-syntax";
        case ErrorCode::NotATriangle:
            return "not-a-triangle";
        case ErrorCode::IndexOutOfRange:
            return "index-out-of-range";
        case ErrorCode::RepeatedVertex:
            return "repeated-vertex";
        case ErrorCode::NotFinite:
            return "not-finite";
        case ErrorCode::BadSharpness:
            return "bad-sharpness";
        case ErrorCode::NoSuchEdge:
            return "no-such-edge";
        case ErrorCode::HoleOutOfRange:
            return "hole-out-of-range";
        case ErrorCode::EmptyMesh:
            return "empty-mesh";
        case ErrorCode::TooLarge:
            return "too-large";
        case ErrorCode::NonManifoldEdge:
            return "non-manifold-edge";
        case ErrorCode::NonManifoldVertex:
            return "non-manifold-vertex";
        case ErrorCode::InconsistentWinding:
            return "inconsistent-winding";
        case ErrorCode::DuplicateFace:
            return "duplicate-face";
        case ErrorCode::TooFewPoints:
            return "too-few-points";
        case ErrorCode::BadKnots:
            return "bad-knots";
        case ErrorCode::OutsideDomain:
            return "outside-domain";
        case ErrorCode::NoLimitSurface:
            return "no-limit-surface";
        case ErrorCode::Unsupported:
            return "unsupported";
        case ErrorCode::OutOfMemory:
            return "out-of-memory";
        case ErrorCode::SubjectFailed:
            return "subject-failed";
    }
    return "unknown";
}

std::string to_string(Place place) {
    switch (place.kind) {
        case Place::Kind::None:
            break;
        case Place::Kind::Line:
            return fmt::format("line {}", place.index);
        case Place::Kind::Vertex:
            return fmt::format("vertex {}", place.index);
        case Place::Kind::Face:
            return fmt::format("face {}", place.index);
        case Place::Kind::Point:
            return fmt::format("point {}", place.index);
    }
    return {};
}

std::string to_string(const Error& error) {
    const std::string where = to_string(error.place);
    return fmt::format("{}{}{} [{}]", where, where.empty() ? "" : ": ", error.sentence,
                       code_name(error.code));
}

}  // namespace loopcheck::core

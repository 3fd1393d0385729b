// The header of a PLY file: which elements there are and of what their rows consist.  Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/io/text_reader.h"

namespace loopcheck::core::ply {

enum class Type : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };
std::size_t size_of(Type type);

/// One column of an element: a number, or a list of numbers with their count before them.
struct Property {
    enum class Use : std::uint8_t { None, X, Y, Z, Corners };

    std::string_view name;
    Type type = Type::Int8;
    std::optional<Type> list_size;  ///< the type of the count, an integer; only in lists
    Use use = Use::None;
};

struct Element {
    std::string_view name;
    long long count = 0;
    std::vector<Property> properties;
};

/// The header.  Its names are views of the file.
///
/// An element "vertex" has one property each for X, Y and Z, numbers; an element "face" has one for Corners,
/// a list of integers.  Neither occurs twice, and their counts fit an Index.
struct Header {
    enum class Coding : std::uint8_t { Text, Little, Big };

    Coding coding = Coding::Text;
    std::vector<Element> elements;
    std::size_t vertex_count = 0;
    std::string description;  ///< the first comment, or empty
};

/// Reads the header to its last line.  Errors: BadSyntax, TooLarge.
Result<Header> read_header(LineReader& lines);

/// The fewest bytes that a row of a binary file has.
std::size_t smallest_row(const Element& element);

/// "The file announces 8 of the element "vertex", but ends after 5."
std::string ends_early(const Element& element, long long found);

}  // namespace loopcheck::core::ply

// Polygon File Format: a header that describes elements, then the elements in text or binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/bytes.h"
#include "core/mesh/io/formats.h"
#include "core/mesh/io/model_builder.h"
#include "core/mesh/io/ply_header.h"
#include "core/mesh/io/writing.h"

namespace loopcheck::core {
namespace {

using ply::Element;
using ply::Header;
using ply::Property;
using ply::Type;

/// The rows of a text file: one a line, one word a number.
class TextRows {
  public:
    explicit TextRows(LineReader& lines) : lines_(lines) {}

    Result<void> begin_row(const Element& element, long long row) {
        if (!lines_.next_with_words())
            return fail_at(spot(), ErrorCode::BadSyntax, ply::ends_early(element, row));
        words_ = Words(lines_.text());
        return {};
    }
    Result<void> end_row(const Element& element) {
        if (words_.empty()) return {};
        return fail_at(spot(), ErrorCode::BadSyntax,
                       fmt::format("The element {} has {} where the line should end.",
                                   in_quotes(element.name), in_quotes(words_.next())));
    }
    /// At most so many numbers can follow in this row.  Counting them would take quadratic time.
    std::size_t room(Type) const { return (words_.rest().size() + 1) / 2; }
    Result<long long> integer(Type) {
        const std::string_view word = words_.next();
        if (const auto value = parse_integer(word)) return *value;
        return bad_word(word, "an integer");
    }
    Result<double> real(Type) {
        const std::string_view word = words_.next();
        if (const auto value = parse_double(word)) return *value;
        return bad_word(word, "a number");
    }
    Result<void> skip(Type type, std::size_t numbers) {
        for (std::size_t i = 0; i < numbers; ++i)
            if (auto value = real(type); !value) return hand_on(value);
        return {};
    }
    Result<void> end_file() {
        if (!lines_.next_with_words()) return {};
        return fail_at(spot(), ErrorCode::BadSyntax,
                       "The file goes on after the last element that it announces.");
    }
    Spot spot() const { return {lines_.number(), 0}; }

  private:
    tl::unexpected<Error> bad_word(std::string_view word, std::string_view wanted) const {
        return fail_at(spot(), ErrorCode::BadSyntax,
                       word.empty() ? fmt::format("The line ends where {} is due.", wanted)
                                    : fmt::format("{} stands where {} is due.", in_quotes(word), wanted));
    }

    LineReader& lines_;
    Words words_{""};
};

/// The rows of a binary file: nothing between the numbers.
class BinaryRows {
  public:
    BinaryRows(std::string_view bytes, std::size_t offset, std::endian order)
        : bytes_(bytes), offset_(offset), order_(order) {}

    /// The file must have room for the numbers of the row that have a fixed size.
    Result<void> begin_row(const Element& element, long long row) {
        if (left() >= ply::smallest_row(element)) return {};
        return fail_at(spot(), ErrorCode::BadSyntax, ply::ends_early(element, row));
    }
    Result<void> end_row(const Element&) { return {}; }
    std::size_t room(Type type) const { return left() / ply::size_of(type); }
    Result<long long> integer(Type type) {
        return take(type).map([](auto value) { return static_cast<long long>(value); });
    }
    Result<double> real(Type type) { return take(type); }
    Result<void> skip(Type type, std::size_t numbers) {
        if (numbers > room(type)) return file_ends();
        offset_ += numbers * ply::size_of(type);
        return {};
    }
    /// Blanks at the end, as an editor may leave, are accepted.
    Result<void> end_file() {
        if (bytes_.find_first_not_of(" \t\r\n", offset_) == std::string_view::npos) return {};
        return fail_at(
            spot(), ErrorCode::BadSyntax,
            fmt::format("The file goes on for {} bytes after the last element that it announces.", left()));
    }
    Spot spot() const { return {0, offset_}; }

  private:
    std::size_t left() const { return bytes_.size() - offset_; }
    tl::unexpected<Error> file_ends() const {
        return fail_at(spot(), ErrorCode::BadSyntax, "The file ends within an element.");
    }
    /// Every type of the format fits into a double.
    Result<double> take(Type type) {
        if (room(type) < 1) return file_ends();
        const std::string_view rest = bytes_.substr(offset_);
        offset_ += ply::size_of(type);
        switch (type) {
            case Type::Int8:
                return load<std::int8_t>(rest, order_);
            case Type::UInt8:
                return load<std::uint8_t>(rest, order_);
            case Type::Int16:
                return load<std::int16_t>(rest, order_);
            case Type::UInt16:
                return load<std::uint16_t>(rest, order_);
            case Type::Int32:
                return load<std::int32_t>(rest, order_);
            case Type::UInt32:
                return load<std::uint32_t>(rest, order_);
            case Type::Float32:
                return static_cast<double>(load<float>(rest, order_));
            case Type::Float64:
                return load<double>(rest, order_);
        }
        return file_ends();
    }

    std::string_view bytes_;
    std::size_t offset_;
    std::endian order_;
};

/// Reads the elements from rows of either kind.
template <class Rows>
class ElementReader {
  public:
    ElementReader(const Header& header, Rows rows, ModelBuilder& builder)
        : header_(header), rows_(std::move(rows)), builder_(builder) {}

    Result<void> read() {
        for (const Element& element : header_.elements) {
            if (element.properties.empty()) continue;  // its rows are nothing at all
            for (long long row = 0; row < element.count; ++row)
                if (auto done = read_row(element, row); !done) return done;
        }
        return rows_.end_file();
    }

  private:
    Result<void> read_row(const Element& element, long long row) {
        if (auto done = rows_.begin_row(element, row); !done) return done;
        auto done = element.name == "vertex" ? read_vertex(element)
                    : element.name == "face" ? read_face(element)
                                             : skip_row(element);
        return done ? rows_.end_row(element) : done;
    }

    Result<void> read_vertex(const Element& element) {
        const Spot spot = rows_.spot();
        glm::dvec3 position;
        for (const Property& property : element.properties) {
            if (property.use == Property::Use::None) {
                if (auto done = skip(property); !done) return done;
                continue;
            }
            const auto value = rows_.real(property.type);
            if (!value) return tl::unexpected(value.error());
            position[static_cast<int>(property.use) - static_cast<int>(Property::Use::X)] = *value;
        }
        return builder_.add_vertex(position, spot);
    }

    Result<void> read_face(const Element& element) {
        const Spot spot = rows_.spot();
        for (const Property& property : element.properties)
            if (auto done = property.use == Property::Use::Corners ? read_corners(property) : skip(property);
                !done)
                return done;
        return builder_.add_face(corners_, spot);
    }

    Result<void> read_corners(const Property& property) {
        corners_.clear();
        const auto size = read_list_size(property);
        if (!size) return tl::unexpected(size.error());
        while (corners_.size() < *size) {
            const Spot spot = rows_.spot();
            const auto index = rows_.integer(property.type);
            if (!index) return tl::unexpected(index.error());
            const auto corner = check_corner(*index, header_.vertex_count, spot);
            if (!corner) return tl::unexpected(corner.error());
            corners_.push_back(*corner);
        }
        return {};
    }

    Result<void> skip_row(const Element& element) {
        for (const Property& property : element.properties)
            if (auto done = skip(property); !done) return done;
        return {};
    }

    Result<void> skip(const Property& property) {
        if (!property.list_size) return rows_.skip(property.type, 1);
        const auto size = read_list_size(property);
        if (!size) return tl::unexpected(size.error());
        return rows_.skip(property.type, *size);
    }

    /// How many numbers a list has: no more than the rest of the file can hold.
    Result<std::size_t> read_list_size(const Property& property) {
        const Spot spot = rows_.spot();
        const auto size = rows_.integer(*property.list_size);
        if (!size) return tl::unexpected(size.error());
        if (*size >= 0 && static_cast<unsigned long long>(*size) <= rows_.room(property.type))
            return static_cast<std::size_t>(*size);
        return fail_at(spot, ErrorCode::BadSyntax,
                       fmt::format("The list {} announces {} numbers, but there is room for {} at most.",
                                   in_quotes(property.name), *size, rows_.room(property.type)));
    }

    const Header& header_;
    Rows rows_;
    ModelBuilder& builder_;
    std::vector<Index> corners_;  ///< of the face at hand
};

Result<void> read_elements(const Header& header, std::string_view bytes, LineReader& lines,
                           ModelBuilder& builder) {
    if (header.coding == Header::Coding::Text) return ElementReader(header, TextRows(lines), builder).read();
    const std::endian order =
        header.coding == Header::Coding::Little ? std::endian::little : std::endian::big;
    return ElementReader(header, BinaryRows(bytes, lines.offset(), order), builder).read();
}

/// "a, b and 7 others", for a sentence about what was ignored.
std::string listed(const std::vector<std::string_view>& names) {
    constexpr std::size_t kMostNames = 10;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
        text += (i > 0 ? ", " : "") + in_quotes(names[i]);
    if (names.size() > kMostNames) text += fmt::format(" and {} others", names.size() - kMostNames);
    return text;
}

void warn_of_ignored(const Header& header, ModelBuilder& builder) {
    std::vector<std::string_view> elements;
    std::vector<std::string_view> properties;
    for (const Element& element : header.elements) {
        const bool known = element.name == "vertex" || element.name == "face";
        if (!known) elements.push_back(element.name);
        for (const Property& property : element.properties)
            if (known && property.use == Property::Use::None) properties.push_back(property.name);
    }
    if (!properties.empty())
        builder.warn(
            fmt::format("These properties of vertices and faces are ignored: {}.", listed(properties)));
    if (!elements.empty()) builder.warn(fmt::format("These elements are ignored: {}.", listed(elements)));
}

constexpr std::size_t kMostCornersInByte = 255;

/// The type of the size of a face: a byte, as most readers expect, where that is enough.
bool sizes_fit_bytes(const MeshData& data) {
    return std::all_of(data.face_sizes.begin(), data.face_sizes.end(),
                       [](Index size) { return static_cast<std::size_t>(size) <= kMostCornersInByte; });
}

std::string header_of(const Model& model, Encoding encoding) {
    std::string text = "ply\n";
    text += encoding == Encoding::Text ? "format ascii 1.0\n" : "format binary_little_endian 1.0\n";
    append_description(text, "comment", model.description);
    text += fmt::format("element vertex {}\n", model.data.positions.size());
    text += "property double x\nproperty double y\nproperty double z\n";
    text += fmt::format("element face {}\n", model.data.face_sizes.size());
    text += fmt::format("property list {} int vertex_indices\nend_header\n",
                        sizes_fit_bytes(model.data) ? "uchar" : "int");
    return text;
}

void append_binary(std::string& bytes, const MeshData& data) {
    constexpr std::endian kOrder = std::endian::little;
    for (const glm::dvec3& position : data.positions)
        for (int i = 0; i < 3; ++i) append(bytes, position[i], kOrder);
    const bool small = sizes_fit_bytes(data);
    for_each_face(data, [&](std::size_t, std::span<const Index> corners) {
        if (small)
            append(bytes, static_cast<std::uint8_t>(corners.size()), kOrder);
        else
            append(bytes, static_cast<std::int32_t>(corners.size()), kOrder);
        for (const Index corner : corners) append(bytes, corner, kOrder);
    });
}

}  // namespace

Result<Model> parse_ply(std::string_view bytes) {
    LineReader lines(bytes);
    auto header = ply::read_header(lines);
    if (!header) return hand_on(header);
    ModelBuilder builder;
    if (auto done = read_elements(*header, bytes, lines, builder); !done) return hand_on(done);
    warn_of_ignored(*header, builder);
    builder.model.description = header->description;
    return std::move(builder.model);
}

Written format_ply(const Model& model, Encoding encoding) {
    Written written{header_of(model, encoding), lost_tags(model, "PLY")};
    if (encoding == Encoding::Binary) {
        append_binary(written.bytes, model.data);
    } else {
        append_vertices(written.bytes, "", model.data);
        append_faces(written.bytes, model.data);
    }
    return written;
}

}  // namespace loopcheck::core

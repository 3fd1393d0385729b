#include "core/mesh/io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/mesh/io/model_builder.h"

namespace loopcheck::core::ply {
namespace {

struct TypeName {
    std::string_view old_name;
    std::string_view name;
    Type type;
    std::size_t size;
};
/// In the order of the enumerators.
constexpr std::array kTypes{
    TypeName{"char", "int8", Type::Int8, 1},        TypeName{"uchar", "uint8", Type::UInt8, 1},
    TypeName{"short", "int16", Type::Int16, 2},     TypeName{"ushort", "uint16", Type::UInt16, 2},
    TypeName{"int", "int32", Type::Int32, 4},       TypeName{"uint", "uint32", Type::UInt32, 4},
    TypeName{"float", "float32", Type::Float32, 4}, TypeName{"double", "float64", Type::Float64, 8}};

std::optional<Type> parse_type(std::string_view word) {
    for (const TypeName& row : kTypes)
        if (row.old_name == word || row.name == word) return row.type;
    return std::nullopt;
}

bool is_integer(Type type) {
    return type != Type::Float32 && type != Type::Float64;
}

class HeaderReader {
  public:
    explicit HeaderReader(LineReader& lines) : lines_(lines) {}

    Result<Header> read() {
        if (!lines_.next() || Words(lines_.text()).rest() != "ply")
            return bad_syntax("The first line is not \"ply\".");
        while (lines_.next_with_words()) {
            Words words(lines_.text());
            const std::string_view keyword = words.next();
            if (keyword == "end_header") return finish();
            if (auto done = read_line(keyword, words); !done) return hand_on(done);
        }
        return bad_syntax("The file ends within the header.");
    }

  private:
    Result<void> read_line(std::string_view keyword, Words words) {
        if (keyword == "format") return read_format(words);
        if (keyword == "element") return read_element(words);
        if (keyword == "property") return read_property(words);
        if (keyword == "comment" && header_.description.empty()) header_.description = words.rest();
        if (keyword == "comment" || keyword == "obj_info") return {};
        return bad_syntax(
            fmt::format("The header has the keyword {}, which is unknown.", in_quotes(keyword)));
    }

    Result<void> read_format(Words words) {
        const std::string_view coding = words.next();
        const std::string_view version = words.rest();
        if (coding == "ascii")
            header_.coding = Header::Coding::Text;
        else if (coding == "binary_little_endian")
            header_.coding = Header::Coding::Little;
        else if (coding == "binary_big_endian")
            header_.coding = Header::Coding::Big;
        else
            return bad_syntax(fmt::format("The format {} is unknown.", in_quotes(coding)));
        if (version != "1.0")
            return bad_syntax(
                fmt::format("The version of the format is {}; 1.0 can be read.", in_quotes(version)));
        has_format_ = true;
        return {};
    }

    Result<void> read_element(Words words) {
        Element element;
        element.name = words.next();
        const std::string_view count = words.next();
        if (!words.empty() || count.empty()) return bad_syntax("An element needs a name and a count.");
        if (element.name == "vertex" || element.name == "face") {
            if (find(element.name))
                return bad_syntax(fmt::format("The element {} occurs twice.", in_quotes(element.name)));
            const auto checked = parse_count(count, element.name == "vertex" ? "vertices" : "faces", spot());
            if (!checked) return tl::unexpected(checked.error());
            element.count = *checked;
        } else {
            const auto any = parse_integer(count);
            if (!any || *any < 0)
                return bad_syntax(fmt::format("The count of an element is {}.", in_quotes(count)));
            element.count = *any;
        }
        header_.elements.push_back(std::move(element));
        return {};
    }

    /// "property float x" or "property list uchar int vertex_indices".
    Result<void> read_property(Words words) {
        if (header_.elements.empty()) return bad_syntax("A property comes before the first element.");
        Property property;
        std::string_view word = words.next();
        if (word == "list") {
            word = words.next();
            property.list_size = parse_type(word);
            if (!property.list_size || !is_integer(*property.list_size))
                return bad_syntax(fmt::format("The size of a list has the type {}; it must be an integer.",
                                              in_quotes(word)));
            word = words.next();
        }
        const auto type = parse_type(word);
        if (!type) return bad_syntax(fmt::format("The type {} is unknown.", in_quotes(word)));
        property.type = *type;
        property.name = words.next();
        if (property.name.empty() || !words.empty()) return bad_syntax("A property needs a type and a name.");
        header_.elements.back().properties.push_back(property);
        return {};
    }

    Result<Header> finish() {
        if (!has_format_) return bad_syntax("The header does not say its format.");
        Element* const vertex = find("vertex");
        if (!vertex) return bad_syntax("The header has no element \"vertex\".");
        for (const auto& [name, use] : {std::pair{"x", Property::Use::X}, std::pair{"y", Property::Use::Y},
                                        std::pair{"z", Property::Use::Z}})
            if (!assign(*vertex, name, use))
                return bad_syntax(fmt::format("The element \"vertex\" has no number \"{}\".", name));
        if (Element* const face = find("face"))
            if (!assign(*face, "vertex_indices", Property::Use::Corners) &&
                !assign(*face, "vertex_index", Property::Use::Corners))
                return bad_syntax("The element \"face\" has no list of integers \"vertex_indices\".");
        header_.vertex_count = static_cast<std::size_t>(vertex->count);
        return std::move(header_);
    }

    Element* find(std::string_view name) {
        for (Element& element : header_.elements)
            if (element.name == name) return &element;
        return nullptr;
    }

    /// Gives the first property of that name its use; false where there is none or its type does not suit.
    static bool assign(Element& element, std::string_view name, Property::Use use) {
        for (Property& property : element.properties) {
            if (property.name != name) continue;
            const bool corners = use == Property::Use::Corners;
            if (property.list_size.has_value() != corners || (corners && !is_integer(property.type)))
                return false;
            property.use = use;
            return true;
        }
        return false;
    }

    Spot spot() const { return {std::max(1LL, lines_.number()), 0}; }
    tl::unexpected<Error> bad_syntax(std::string sentence) const {
        return fail_at(spot(), ErrorCode::BadSyntax, std::move(sentence));
    }

    LineReader& lines_;
    Header header_;
    bool has_format_ = false;
};

}  // namespace

std::size_t size_of(Type type) {
    return kTypes[static_cast<std::size_t>(type)].size;
}

Result<Header> read_header(LineReader& lines) {
    return HeaderReader(lines).read();
}

std::size_t smallest_row(const Element& element) {
    std::size_t bytes = 0;
    for (const Property& property : element.properties)
        bytes += size_of(property.list_size.value_or(property.type));
    return bytes;
}

std::string ends_early(const Element& element, long long found) {
    return fmt::format("The file announces {} of the element {}, but ends after {}.", element.count,
                       in_quotes(element.name), found);
}

}  // namespace loopcheck::core::ply

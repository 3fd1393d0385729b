// One chunk of an HTML report: a header and arrays, compressed.  compare/report/page/src/format.ts has the
// format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace loopcheck::compare {

/// Index of an array in its chunk.
using ArrayRef = std::size_t;

/// Gathers the arrays of a chunk, in byte planes.
class ChunkWriter {
  public:
    /// Adds an array of 8-, 16- or 32-bit integers, float or double; a point is three doubles.  `base` is an
    /// array of the same type and length whose bits this one's are combined with by exclusive or: what is
    /// equal, or nearly, then compresses to nothing.
    template <class Element>
    ArrayRef add(const std::vector<Element>& values, std::optional<ArrayRef> base = std::nullopt) {
        if constexpr (std::is_same_v<Element, glm::dvec3>)
            return add("f64", sizeof(double), std::as_bytes(std::span(values)), base);
        else
            return add(type_name<Element>(), sizeof(Element), std::as_bytes(std::span(values)), base);
    }

    /// Adds indices below `count`, in the smallest of the types u8, u16 and u32 that can hold them.
    ArrayRef add_indices(const std::vector<std::uint32_t>& values, std::size_t count);

    /// The chunk, in Base64; the header with its `arrays`.  Same input, same bytes.
    std::string text(nlohmann::ordered_json header) &&;

  private:
    struct Array {
        std::string_view type;
        std::size_t count, at;  // in `planes_`
        std::optional<ArrayRef> base;
    };

    template <class Element>
    static constexpr std::string_view type_name() {
        if constexpr (std::is_same_v<Element, std::uint8_t>) return "u8";
        if constexpr (std::is_same_v<Element, std::uint16_t>) return "u16";
        if constexpr (std::is_same_v<Element, std::uint32_t>) return "u32";
        if constexpr (std::is_same_v<Element, std::int32_t>) return "i32";
        if constexpr (std::is_same_v<Element, float>) return "f32";
        if constexpr (std::is_same_v<Element, double>) return "f64";
    }
    ArrayRef add(std::string_view type, std::size_t element_size, std::span<const std::byte> bytes,
                 std::optional<ArrayRef> base);

    std::vector<Array> arrays_;
    std::string planes_;
};

}  // namespace loopcheck::compare

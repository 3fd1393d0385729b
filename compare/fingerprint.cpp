#include "compare/fingerprint.h"

#include <zlib.h>

#include <array>
#include <fstream>

namespace loopcheck::compare {
namespace {

std::uint32_t crc32_after(std::uint32_t before, std::string_view bytes) {
    return static_cast<std::uint32_t>(
        ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

std::uint32_t crc32_of(std::string_view bytes) {
    return crc32_after(0, bytes);
}

std::optional<Fingerprint> fingerprint(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
    std::ifstream in(path, std::ios::binary);
    std::array<char, 1 << 16> block;
    Fingerprint out;
    while (in.read(block.data(), block.size()), in.gcount() > 0) {
        const std::string_view bytes(block.data(), static_cast<std::size_t>(in.gcount()));
        out.bytes += bytes.size();
        out.crc32 = crc32_after(out.crc32, bytes);
    }
    if (!in.eof()) return std::nullopt;
    return out;
}

}  // namespace loopcheck::compare

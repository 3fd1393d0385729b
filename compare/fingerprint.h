// What tells files and reports from others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace loopcheck::compare {

/// CRC-32, as zip and gzip have it.
std::uint32_t crc32_of(std::string_view bytes);

struct Fingerprint {
    std::uint64_t bytes = 0;
    std::uint32_t crc32 = 0;

    bool operator==(const Fingerprint&) const = default;
};

/// Of the content of a plain file; nothing where it is none, or cannot be read.
std::optional<Fingerprint> fingerprint(const std::filesystem::path& path);

}  // namespace loopcheck::compare

#include "compare/report/html/chunk.h"

#define ZLIB_CONST  // what is compressed is const
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

#include "compare/report/document.h"
#include "core/mesh/io/bytes.h"

namespace loopcheck::compare {
namespace {

// What deflate takes and gives at a time.
constexpr std::size_t kPiece = 1 << 16;
constexpr int kLevel = 6;
constexpr int kGzip = 15 + 16;  // the largest window, and a header that has no time in it

class Gzip {
  public:
    Gzip() {
        if (deflateInit2(&stream_, kLevel, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    ~Gzip() { deflateEnd(&stream_); }
    Gzip(const Gzip&) = delete;
    Gzip& operator=(const Gzip&) = delete;

    void add(std::string_view bytes) {
        for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kPiece)))
            run(bytes.substr(0, kPiece), Z_NO_FLUSH);
    }
    std::string finish() && {
        run({}, Z_FINISH);
        return std::move(out_);
    }

  private:
    void run(std::string_view piece, int flush) {
        stream_.next_in = reinterpret_cast<const Bytef*>(piece.data());
        stream_.avail_in = static_cast<uInt>(piece.size());
        do {
            stream_.next_out = buffer_.data();
            stream_.avail_out = static_cast<uInt>(buffer_.size());
            deflate(&stream_, flush);
            out_.append(reinterpret_cast<const char*>(buffer_.data()), buffer_.size() - stream_.avail_out);
        } while (stream_.avail_out == 0);
    }

    z_stream stream_{};
    std::array<Bytef, kPiece> buffer_;
    std::string out_;
};

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8U | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0U);
        for (std::size_t i = 0; i < 4; ++i) out += i <= count ? kDigits[group >> (18 - 6 * i) & 63U] : '=';
    }
    return out;
}

}  // namespace

ArrayRef ChunkWriter::add(std::string_view type, std::size_t element_size, std::span<const std::byte> bytes,
                          std::optional<ArrayRef> base) {
    const std::size_t count = bytes.size() / element_size, at = planes_.size();
    planes_.reserve(at + bytes.size());
    for (std::size_t plane = 0; plane < element_size; ++plane) {
        const std::size_t byte =
            std::endian::native == std::endian::little ? plane : element_size - 1 - plane;
        for (std::size_t i = 0; i < count; ++i) planes_ += static_cast<char>(bytes[i * element_size + byte]);
    }
    // The base is stored combined with its own base, if it has one.
    for (auto below = base; below; below = arrays_[*below].base) {
        const Array& other = arrays_.at(*below);
        if (other.type != type || other.count != count)
            throw std::logic_error("An array of a report cannot be combined with that one.");
        for (std::size_t i = 0; i < bytes.size(); ++i)
            planes_[at + i] = static_cast<char>(planes_[at + i] ^ planes_[other.at + i]);
    }
    arrays_.push_back({type, count, at, base});
    return arrays_.size() - 1;
}

ArrayRef ChunkWriter::add_indices(const std::vector<std::uint32_t>& values, std::size_t count) {
    const auto fits = [&](std::size_t most) { return count <= most + 1; };
    if (fits(std::numeric_limits<std::uint8_t>::max()))
        return add(std::vector<std::uint8_t>(values.begin(), values.end()));
    if (fits(std::numeric_limits<std::uint16_t>::max()))
        return add(std::vector<std::uint16_t>(values.begin(), values.end()));
    return add(values);
}

std::string ChunkWriter::text(nlohmann::ordered_json header) && {
    header["arrays"] = nlohmann::ordered_json::array();
    for (const Array& array : arrays_) {
        nlohmann::ordered_json entry{{"type", array.type}, {"count", array.count}};
        if (array.base) entry["xor"] = *array.base;
        header["arrays"].push_back(std::move(entry));
    }
    const std::string json = dump_compact(header);
    std::string length;
    core::append(length, static_cast<std::uint32_t>(json.size()), std::endian::little);
    Gzip gzip;
    gzip.add(length);
    gzip.add(json);
    gzip.add(planes_);
    planes_ = {};
    return base64(std::move(gzip).finish());
}

}  // namespace loopcheck::compare

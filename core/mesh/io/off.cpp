// Object File Format of Geomview: a header word, a line of counts, a line a vertex, a line a face.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/formats.h"
#include "core/mesh/io/model_builder.h"
#include "core/mesh/io/writing.h"

namespace loopcheck::core {
namespace {

/// How many numbers follow the coordinates of a vertex: 3 of a normal, 3 or 4 of a colour, 2 of a texture.
struct ExtraNumbers {
    std::size_t least = 0;
    std::size_t most = 0;
};

/// Reads the header word: OFF, with the letters ST, C and N before it in this order, each once at most.
std::optional<ExtraNumbers> parse_header(std::string_view word) {
    ExtraNumbers extra;
    const auto take = [&](std::string_view letters, std::size_t least, std::size_t most) {
        if (!word.starts_with(letters)) return;
        word.remove_prefix(letters.size());
        extra.least += least;
        extra.most += most;
    };
    take("ST", 2, 2);
    take("C", 3, 4);
    take("N", 3, 3);
    if (word != "OFF") return std::nullopt;
    return extra;
}

class OffReader {
  public:
    explicit OffReader(std::string_view bytes) : lines_(bytes, {.comments = true}) {}

    Result<Model> read() {
        if (auto done = read_head(); !done) return hand_on(done);
        for (Index i = 0; i < vertices_; ++i)
            if (auto done = read_vertex(i); !done) return hand_on(done);
        for (Index i = 0; i < faces_; ++i)
            if (auto done = read_face(i); !done) return hand_on(done);
        if (lines_.next_with_words()) return count_mismatch();
        warn();
        builder_.model.description = lines_.description();
        return std::move(builder_.model);
    }

  private:
    /// The header word and the counts, in the same line or the next.
    Result<void> read_head() {
        if (!lines_.next_with_words()) return bad_syntax("The file has no header OFF.");
        Words words(lines_.text());
        const std::string_view header = words.next();
        const auto extra = parse_header(header);
        if (!extra)
            return bad_syntax(
                fmt::format("The header is {}; OFF can be read, with the letters ST, C and N before it.",
                            in_quotes(header)));
        extra_ = *extra;
        if (Words(words).next() == "BINARY") return bad_syntax("Binary OFF cannot be read, only text.");
        if (!words.empty()) return read_counts(words);
        if (!lines_.next_with_words())
            return bad_syntax("The file ends before the numbers of vertices and faces.");
        return read_counts(Words(lines_.text()));
    }

    /// "vertices faces edges".  Nobody counts the edges; they may be missing.
    Result<void> read_counts(Words words) {
        const auto vertices = parse_count(words.next(), "vertices", spot());
        if (!vertices) return tl::unexpected(vertices.error());
        const auto faces = parse_count(words.next(), "faces", spot());
        if (!faces) return tl::unexpected(faces.error());
        if (!words.empty() && !parse_integer(words.next()))
            return bad_syntax("The number of edges is no integer.");
        if (!words.empty()) return bad_syntax("The line of counts has more than three numbers.");
        vertices_ = *vertices;
        faces_ = *faces;
        return {};
    }

    Result<void> read_vertex(Index found) {
        if (!lines_.next_with_words()) return file_ends(found, 0);
        Words words(lines_.text());
        const auto position = parse_position(words, spot());
        if (!position) return tl::unexpected(position.error());
        const std::size_t extra = words.count();
        if (extra < extra_.least || extra > extra_.most)
            return bad_syntax(fmt::format(
                "A vertex has {} numbers, but the header asks for {}{}.", 3 + extra, 3 + extra_.least,
                extra_.most > extra_.least ? fmt::format(" or {}", 3 + extra_.most) : ""));
        if (auto done = skip_numbers(words, spot()); !done) return done;
        if (extra > 0) extra_numbers_.add(spot().line);
        return builder_.add_vertex(*position, spot());
    }

    /// "3 0 1 2", then up to four numbers of a colour.
    Result<void> read_face(Index found) {
        constexpr std::size_t kMostColours = 4;
        if (!lines_.next_with_words()) return file_ends(vertices_, found);
        Words words(lines_.text());
        const std::string_view first = words.next();
        const auto size = parse_integer(first);
        if (!size || *size < 0)
            return bad_syntax(
                fmt::format("A face begins with {} instead of the number of its corners.", in_quotes(first)));
        const std::size_t given = words.count();
        if (static_cast<unsigned long long>(*size) > given)
            return bad_syntax(fmt::format("A face announces {} corners, but has {}.", *size, given));
        if (auto done = read_corners(words, static_cast<std::size_t>(*size)); !done) return done;
        if (words.count() > kMostColours)
            return bad_syntax(fmt::format("A face of {} corners has {} more words; a colour has up to four.",
                                          *size, words.count()));
        if (!words.empty()) face_colours_.add(spot().line);
        if (auto done = skip_numbers(words, spot()); !done) return done;
        return builder_.add_face(corners_, spot());
    }

    Result<void> read_corners(Words& words, std::size_t size) {
        corners_.clear();
        while (corners_.size() < size) {
            const auto corner = parse_corner(words.next(), builder_.model.data.positions.size(), spot());
            if (!corner) return tl::unexpected(corner.error());
            corners_.push_back(*corner);
        }
        return {};
    }

    tl::unexpected<Error> file_ends(Index vertices, Index faces) const {
        return bad_syntax(
            fmt::format("The file announces {} vertices and {} faces, but ends after {} and {}.", vertices_,
                        faces_, vertices, faces));
    }

    /// For a line after the last face: counts what is there.
    tl::unexpected<Error> count_mismatch() {
        const Spot first = spot();
        const long long announced = static_cast<long long>(vertices_) + faces_;
        long long found = announced + 1;
        while (lines_.next_with_words()) ++found;
        return fail_at(
            first, ErrorCode::BadSyntax,
            fmt::format("The file announces {} vertices and {} faces, {} lines together, but has {} lines.",
                        vertices_, faces_, announced, found));
    }

    void warn() {
        if (extra_numbers_.count > 0)
            builder_.warn(
                fmt::format("A vertex has a normal, a colour or a texture coordinate, which is ignored ({}).",
                            to_string(extra_numbers_)));
        if (face_colours_.count > 0)
            builder_.warn(
                fmt::format("A face has a colour, which is ignored ({}).", to_string(face_colours_)));
    }

    /// The line at hand; the first one of an empty file.
    Spot spot() const { return {std::max(1LL, lines_.number()), 0}; }
    tl::unexpected<Error> bad_syntax(std::string sentence) const {
        return fail_at(spot(), ErrorCode::BadSyntax, std::move(sentence));
    }

    LineReader lines_;
    ModelBuilder builder_;
    ExtraNumbers extra_;
    Index vertices_ = 0;
    Index faces_ = 0;
    std::vector<Index> corners_;  ///< of the face at hand
    Tally extra_numbers_;
    Tally face_colours_;
};

}  // namespace

Result<Model> parse_off(std::string_view bytes) {
    return OffReader(bytes).read();
}

Written format_off(const Model& model) {
    const MeshData& data = model.data;
    Written written{"OFF\n", lost_tags(model, "OFF")};
    append_description(written.bytes, "#", model.description);
    written.bytes += fmt::format("{} {} 0\n", data.positions.size(), data.face_sizes.size());
    append_vertices(written.bytes, "", data);
    append_faces(written.bytes, data);
    return written;
}

}  // namespace loopcheck::core

// Lines and words of a text file, read in place.  Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace loopcheck::core {

/// The words of one line, one after the other.  Words are separated by blanks.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {
        while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
        skip_blanks();
    }

    bool empty() const { return rest_.empty(); }

    /// The next word; empty after the last.
    std::string_view next() {
        std::size_t length = 0;
        while (length < rest_.size() && !is_blank(rest_[length])) ++length;
        const std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        skip_blanks();
        return word;
    }

    /// Everything that is left, blanks at both ends removed.
    std::string_view rest() const { return rest_; }

    /// How many words are left.
    std::size_t count() const {
        Words copy = *this;
        std::size_t words = 0;
        for (; !copy.empty(); copy.next()) ++words;
        return words;
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    void skip_blanks() {
        std::size_t blanks = 0;
        while (blanks < rest_.size() && is_blank(rest_[blanks])) ++blanks;
        rest_.remove_prefix(blanks);
    }

    std::string_view rest_;
};

/// What a format adds to plain lines.
struct LineSyntax {
    bool comments = false;      ///< '#' and what follows it is a comment
    bool continuation = false;  ///< a backslash at the end joins the next line; not inside a comment
};

/// The lines of a file, which end with LF, CR LF or CR.  A UTF-8 byte order mark at the start is skipped.
class LineReader {
  public:
    explicit LineReader(std::string_view bytes, LineSyntax syntax = {}) : bytes_(bytes), syntax_(syntax) {
        if (bytes_.starts_with("\xEF\xBB\xBF")) offset_ = 3;
    }
    LineReader(const LineReader&) = delete;  // text_ may point into joined_
    LineReader& operator=(const LineReader&) = delete;

    /// Goes to the next line; false where there is none.
    bool next() {
        if (offset_ >= bytes_.size()) return false;
        number_ = lines_ + 1;
        text_ = take_line();
        if (syntax_.continuation && text_.ends_with('\\')) join_continued();
        return true;
    }

    /// Goes to the next line that has a word; false where there is none.
    bool next_with_words() {
        while (next())
            if (!Words(text_).empty()) return true;
        return false;
    }

    /// The line without its comment and its end.  Valid until `next`.
    std::string_view text() const { return text_; }
    /// The number of the line, from 1; of the first of several joined ones.
    long long number() const { return number_; }
    /// How many bytes have been read.
    std::size_t offset() const { return offset_; }
    /// The first comment line that has a letter or digit (others are decoration), trimmed; or empty.
    std::string_view description() const { return description_; }

  private:
    std::string_view take_line() {
        std::size_t end = offset_;
        while (end < bytes_.size() && bytes_[end] != '\n' && bytes_[end] != '\r') ++end;
        const std::string_view line = bytes_.substr(offset_, end - offset_);
        const bool two = bytes_.substr(end).starts_with("\r\n");
        offset_ = std::min(bytes_.size(), end + (two ? 2 : 1));
        ++lines_;
        return syntax_.comments ? without_comment(line) : line;
    }

    std::string_view without_comment(std::string_view line) {
        const std::size_t hash = line.find('#');
        if (hash == std::string_view::npos) return line;
        const std::string_view text = line.substr(0, hash);
        if (description_.empty() && Words(text).empty() && says_something(line.substr(hash)))
            description_ = Words(line.substr(hash + 1)).rest();
        return text;
    }

    /// A word does not go on in the next line: the backslash stands for a blank.
    void join_continued() {
        joined_.assign(text_);
        while (joined_.ends_with('\\')) {
            joined_.back() = ' ';
            if (offset_ < bytes_.size()) joined_ += take_line();
        }
        text_ = joined_;
    }

    static bool says_something(std::string_view comment) {
        return std::any_of(comment.begin(), comment.end(), [](char c) {
            const auto byte = static_cast<unsigned char>(c);
            const int letter = byte | 0x20;
            return byte >= 0x80 || (letter >= 'a' && letter <= 'z') || (byte >= '0' && byte <= '9');
        });
    }

    std::string_view bytes_;
    LineSyntax syntax_;
    std::size_t offset_ = 0;
    long long lines_ = 0;
    long long number_ = 0;
    std::string_view text_;
    std::string joined_;
    std::string_view description_;
};

}  // namespace loopcheck::core

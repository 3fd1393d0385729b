#include "compare/report/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "compare/limit/words.h"
#include "compare/report/document.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

// -- Reading

// More than any report has.
constexpr std::size_t kDeepest = 32;
constexpr std::size_t kMostKeys = 1000;  // of an object: each is looked for among those before it
// A value and its key as they are kept, with room to grow.
constexpr double kBytesPerValue = 160;

core::Result<Json> parse(std::string_view bytes, double memory_limit) {
    const double most_values = memory_limit / kBytesPerValue;
    double values = 0;
    bool strange = false;
    std::array<std::size_t, kDeepest + 2> keys{};
    const auto watch = [&](int depth, Json::parse_event_t event, const Json&) {
        const auto d = static_cast<std::size_t>(depth);
        strange = strange || d > kDeepest;
        if (!strange && event == Json::parse_event_t::object_start) keys[d + 1] = 0;
        if (!strange && event == Json::parse_event_t::key) strange = ++keys[d] > kMostKeys;
        return !strange && ++values <= most_values;
    };
    Json out = Json::parse(bytes, watch, false);
    if (strange || (out.is_discarded() && values <= most_values))
        return core::fail(core::ErrorCode::BadSyntax, "This is no JSON report, or not all of one.");
    if (values > most_values)
        return core::fail(core::ErrorCode::OutOfMemory, "There is not enough memory for so large a report.");
    return out;
}

// Takes values out of a report.  What is not as docs/report.schema.json has it is read as nothing, and the
// first of it is the error.
class Reader {
  public:
    void fail(const char* key) {
        if (!error_)
            error_ =
                core::Error{core::ErrorCode::BadSyntax,
                            fmt::format("{}\"{}\" is missing, or not as docs/report.schema.json has it.",
                                        list_ == nullptr ? "" : fmt::format("{}[{}]: ", list_, index_), key)};
    }

    const std::optional<core::Error>& error() const { return error_; }

    const Json& object(const Json& in, const char* key) { return get(in, key, Json::value_t::object); }
    const Json& array(const Json& in, const char* key) { return get(in, key, Json::value_t::array); }
    bool flag(const Json& in, const char* key) {
        const Json& value = get(in, key, Json::value_t::boolean);
        return value.is_boolean() && value.get<bool>();
    }

    // What `read` makes of each entry of a list; the error names the entry.
    template <class Read>
    auto entries(const Json& in, const char* key, Read read) {
        std::vector<decltype(read(in))> out;
        for (const Json& entry : array(in, key)) {
            list_ = key;
            index_ = out.size();
            out.push_back(read(entry));
        }
        list_ = nullptr;
        return out;
    }

    std::string text(const Json& in, const char* key) {
        const Json& value = get(in, key, Json::value_t::string);
        return value.is_string() ? value.get<std::string>() : std::string();
    }

    std::vector<std::string> texts(const Json& in, const char* key) {
        std::vector<std::string> out;
        for (const Json& value : array(in, key))
            if (value.is_string())
                out.push_back(value.get<std::string>());
            else
                fail(key);
        return out;
    }

    template <class Integer>
    Integer count(const Json& in, const char* key) {
        const Json& value = get(in, key, Json::value_t::number_unsigned);
        const auto n = value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
        if (n <= static_cast<std::uint64_t>(std::numeric_limits<Integer>::max()))
            return static_cast<Integer>(n);
        fail(key);
        return 0;
    }

    // Null is a number that is not finite.
    double magnitude(const Json& in, const char* key) {
        const auto found = in.is_object() ? in.find(key) : in.end();
        if (found != in.end() && found->is_null()) return std::numeric_limits<double>::infinity();
        if (found != in.end() && found->is_number()) return found->get<double>();
        fail(key);
        return 0;
    }

    // What `parse` makes of a text: one of a few words.
    template <class Parse>
    auto word(const Json& in, const char* key, Parse parse) {
        const auto value = parse(text(in, key));
        if (!value) fail(key);
        return value.value_or(typename decltype(parse(std::string_view()))::value_type{});
    }

  private:
    const Json& get(const Json& in, const char* key, Json::value_t type) {
        static const Json nothing;
        const auto found = in.is_object() ? in.find(key) : in.end();
        if (found != in.end() && found->type() == type) return *found;
        fail(key);
        return nothing;
    }

    const char* list_ = nullptr;
    std::size_t index_ = 0;
    std::optional<core::Error> error_;
};

// The value up to `last` that has this name.
template <auto last, class Name>
std::optional<decltype(last)> value_named(std::string_view text, Name name) {
    for (int i = 0; i <= static_cast<int>(last); ++i)
        if (const auto value = static_cast<decltype(last)>(i); name(value) == text) return value;
    return std::nullopt;
}

std::optional<Verdict> parse_verdict(std::string_view text) {
    return value_named<Verdict::Failed>(text, [](Verdict verdict) { return name(verdict); });
}

std::optional<core::Precision> parse_precision(std::string_view text) {
    return value_named<core::Precision::Double>(text, [](core::Precision p) { return core::name(p); });
}

std::optional<core::ErrorCode> parse_error_code(std::string_view text) {
    return value_named<core::ErrorCode::SubjectFailed>(text, core::code_name);
}

std::optional<std::uint32_t> parse_hexadecimal(std::string_view text) {
    std::uint32_t out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return out;
}

// An angle that `in_degrees` makes these degrees of.
double in_radians(double degrees) {
    const double near = degrees / in_degrees(1);
    for (const double angle : {std::nextafter(near, 0.0), std::nextafter(near, 2 * near)})
        if (in_degrees(angle) == degrees) return angle;
    return near;
}

Subject read_subject(Reader& in, const Json& entry) {
    Subject out;
    out.name = in.text(entry, "name");
    out.version = in.text(entry, "version");
    out.precision = in.word(entry, "precision", parse_precision);
    return out;
}

CorpusModel read_corpus_model(Reader& in, const Json& entry) {
    CorpusModel out{in.text(entry, "model"), {}};
    if (entry.contains("crc32"))
        out.fingerprint = {in.count<std::uint64_t>(entry, "bytes"),
                           in.word(entry, "crc32", parse_hexadecimal)};
    return out;
}

ShardOfSuite read_shard_of_suite(Reader& in, const Json& entry) {
    ShardOfSuite out;
    out.shard = {in.count<int>(entry, "index"), in.count<int>(entry, "of")};
    if (out.shard.index >= out.shard.of) in.fail("index");
    out.cases = in.count<std::size_t>(entry, "cases");
    out.scope = in.flag(entry, "limits") ? Scope::Limits : Scope::Refinement;
    out.triangulate = in.flag(entry, "triangulate");
    out.corpus = in.entries(entry, "corpus", [&](const Json& model) { return read_corpus_model(in, model); });
    return out;
}

// Its sentence begins with the place.
UnreadableModel read_unreadable(Reader& in, const Json& entry) {
    UnreadableModel out{in.text(entry, "model"), {in.word(entry, "code", parse_error_code), {}}};
    std::string text = in.text(entry, "error");
    const std::string code = fmt::format(" [{}]", core::code_name(out.error.code));
    if (text.ends_with(code))
        text.resize(text.size() - code.size());
    else
        in.fail("error");
    out.error.sentence = std::move(text);
    return out;
}

ErrorStats read_largest(Reader& in, const Json& statistics) {
    ErrorStats out;
    out.max = in.magnitude(in.object(statistics, "difference"), "max");
    return out;
}

DeviationSeen read_deviation(Reader& in, const Json& entry) {
    DeviationSeen out;
    out.deviation = find_deviation(known_deviations(), in.text(entry, "name"));
    if (out.deviation == nullptr) in.fail("name");
    out.vertices = in.count<std::size_t>(entry, "vertices");
    const Json& position = in.object(entry, "position");
    out.predicted_position = in.magnitude(position, "predicted");
    out.observed_position = in.magnitude(position, "observed");
    const Json& normal = in.object(entry, "normal");
    out.predicted_angle = in_radians(in.magnitude(normal, "predicted"));
    out.observed_angle = in_radians(in.magnitude(normal, "observed"));
    return out;
}

LimitComparison read_limits(Reader& in, const Json& entry) {
    LimitComparison out;
    out.verdict = in.word(entry, "verdict", parse_verdict);
    out.notes = in.texts(entry, "notes");
    for (const Json& seen : in.array(entry, "deviations")) out.deviations.push_back(read_deviation(in, seen));
    for (const Json& level : in.array(entry, "levels"))
        out.levels.emplace_back().classes[{}].position.difference =
            read_largest(in, in.object(in.object(level, "all"), "position"));
    return out;
}

SuiteRow read_row(Reader& in, const Json& entry, std::span<const Subject> subjects) {
    SuiteRow out{in.text(entry, "model"), {}, std::nullopt};
    Comparison& c = out.comparison;
    c.subject = in.text(entry, "subject");
    c.reference = in.text(entry, "reference");
    for (const auto& [who, precision] :
         {std::pair(&c.subject, &c.subject_precision), std::pair(&c.reference, &c.reference_precision)}) {
        const Subject* subject = find_subject(subjects, *who);
        if (subject == nullptr)
            in.fail("subject");
        else
            *precision = subject->precision;
    }
    c.options.boundary = in.word(entry, "boundary", core::parse_boundary_rule);
    c.options.creasing = in.word(entry, "creasing", core::parse_creasing);
    c.options.weights = in.word(entry, "weights", core::parse_weights);
    c.verdict = in.word(entry, "verdict", parse_verdict);
    c.notes = in.texts(entry, "notes");
    c.largest_coordinate = in.magnitude(entry, "largest_coordinate");
    for (const Json& level : in.array(entry, "levels"))
        c.levels.emplace_back().classes[{}].difference = read_largest(in, in.object(level, "all"));
    if (entry.contains("limits")) out.limits = read_limits(in, in.object(entry, "limits"));
    return out;
}

// -- Merging

std::string subjects_in_words(std::span<const Subject> subjects) {
    std::vector<std::string> out;
    for (const Subject& subject : subjects)
        out.push_back(fmt::format("{} {}", subject.name, subject.version));
    return fmt::format("{}", fmt::join(out, ", "));
}

// What must be the same in all shards, but for the models.
std::vector<std::string> suite_in_words(const ShardReport& report) {
    const ShardOfSuite& part = *report.suite.shard;
    return {counted(static_cast<std::size_t>(part.shard.of), "shard"),
            fmt::format("levels 0 to {}", report.suite.levels),
            part.scope == Scope::Limits ? "with limits" : "without limits",
            part.triangulate ? "with --triangulate" : "without --triangulate",
            subjects_in_words(report.subjects),
            counted(part.corpus.size(), "model")};
}

// How the suite of one shard is not that of another; empty where it is.
std::string difference_of(const ShardReport& report, const ShardReport& other) {
    const auto here = suite_in_words(report), there = suite_in_words(other);
    for (std::size_t i = 0; i < here.size(); ++i)
        if (here[i] != there[i]) return fmt::format("{}, not {}", here[i], there[i]);
    for (std::size_t m = 0; m < report.suite.shard->corpus.size(); ++m) {
        const CorpusModel &one = report.suite.shard->corpus[m], &same = other.suite.shard->corpus[m];
        if (one.name != same.name) return fmt::format("{}, not {}", one.name, same.name);
        if (one.fingerprint != same.fingerprint) return one.name + " is another file";
    }
    return {};
}

// The shards of `of` that are not in `seen`: "1/4, 3/4"; the first few of many.
std::string missing(const std::map<int, const ShardReport*>& seen, int of) {
    constexpr std::size_t kMostListed = 20;
    const std::size_t all = static_cast<std::size_t>(of) - seen.size();
    std::vector<std::string> out;
    for (int i = 0; i < of && out.size() < kMostListed; ++i)
        if (!seen.contains(i)) out.push_back(fmt::format("{}/{}", i, of));
    return fmt::format("{}{}", fmt::join(out, ", "),
                       all > out.size() ? fmt::format(" and {} more", all - out.size()) : "");
}

std::vector<std::string> why_not_all_of_one(std::span<const ShardReport> shards) {
    std::vector<std::string> out;
    std::map<int, const ShardReport*> seen;
    for (const ShardReport& report : shards) {
        const Shard& shard = report.suite.shard->shard;
        if (const auto why = difference_of(report, shards.front()); !why.empty()) {
            out.push_back(
                fmt::format("{} is of another suite than {}: {}.", report.file, shards.front().file, why));
            continue;
        }
        const auto [other, is_new] = seen.try_emplace(shard.index, &report);
        if (!is_new)
            out.push_back(fmt::format("{} and {} are both shard {}/{}.", other->second->file, report.file,
                                      shard.index, shard.of));
    }
    if (const int of = shards.front().suite.shard->shard.of; seen.size() < static_cast<std::size_t>(of))
        out.push_back(fmt::format("Missing: shard {}.", missing(seen, of)));
    return out;
}

// A shard, and how far it was taken into the whole.
struct Cursor {
    ShardReport* report = nullptr;
    std::size_t row = 0, unreadable = 0;

    // The next model that could not be read, if it is this one.
    std::optional<UnreadableModel> take_unreadable(const std::string& model) {
        auto& all = report->suite.unreadable;
        if (unreadable == all.size() || all[unreadable].model != model) return std::nullopt;
        return std::move(all[unreadable++]);
    }
};

class Merger {
  public:
    // Requires every shard, once.
    explicit Merger(std::vector<ShardReport>& shards) {
        cursors_.resize(shards.size());
        for (ShardReport& report : shards)
            cursors_[static_cast<std::size_t>(report.suite.shard->shard.index)].report = &report;
        out_.levels = shards.front().suite.levels;
    }

    // Takes everything, case by case; the first thing out of place is the error.
    std::optional<std::string> run() {
        const auto& corpus = cursors_.front().report->suite.shard->corpus;
        out_.models = corpus.size();
        for (std::size_t m = 0; m < corpus.size(); ++m)
            if (auto error = take_model(m, corpus[m].name)) return error;
        for (const Cursor& c : cursors_)
            if (c.row < c.report->suite.rows.size() || c.unreadable < c.report->suite.unreadable.size())
                return fmt::format("{} has what is not of its cases.", c.report->file);
        return std::nullopt;
    }

    SuiteResult suite() && { return std::move(out_); }
    Json comparisons() && { return std::move(comparisons_); }

  private:
    using Pairs = std::vector<std::pair<std::string, std::string>>;

    Cursor& owner(std::size_t model, std::size_t boundary) {
        return cursors_[Shard::index_of(model, boundary, static_cast<int>(cursors_.size()))];
    }

    std::optional<std::string> take_model(std::size_t m, const std::string& model) {
        std::optional<UnreadableModel> bad = owner(m, 0).take_unreadable(model);
        std::vector<std::string> with, without;
        for (std::size_t b = 0; b < kSuiteBoundaries.size(); ++b) {
            Cursor& c = owner(m, b);
            c.take_unreadable(model);  // for a reason of that machine; said once
            const Pairs pairs = take_case(c, model, kSuiteBoundaries[b]);
            (pairs.empty() ? without : with).push_back(c.report->file);
            if (pairs.empty()) continue;
            if (pairs_.empty()) pairs_ = pairs;
            if (pairs != pairs_)
                return fmt::format("{} has not the comparisons of {} that others have.", c.report->file,
                                   model);
        }
        if (with.empty() && bad) {
            out_.unreadable.push_back(std::move(*bad));
            return std::nullopt;
        }
        if (without.empty() && !bad) return std::nullopt;
        if (with.empty()) return fmt::format("{} is in no shard; {} should have it.", model, without.front());
        return fmt::format("{} was compared in {}, and not in {}: run both again, with the same --memory.",
                           model, with.front(), without.empty() ? owner(m, 0).report->file : without.front());
    }

    // Moves the rows of a case to the whole; which pairs they compare.
    Pairs take_case(Cursor& c, const std::string& model, core::BoundaryRule boundary) {
        Pairs out;
        auto& rows = c.report->suite.rows;
        for (; c.row < rows.size() && rows[c.row].model == model &&
               rows[c.row].comparison.options.boundary == boundary;
             ++c.row) {
            out.emplace_back(rows[c.row].comparison.subject, rows[c.row].comparison.reference);
            out_.rows.push_back(std::move(rows[c.row]));
            comparisons_.push_back(std::move(c.report->comparisons[c.row]));
        }
        return out;
    }

    std::vector<Cursor> cursors_;
    Pairs pairs_;  // of every case
    SuiteResult out_;
    Json comparisons_ = Json::array();
};

}  // namespace

core::Result<ShardReport> read_shard(std::string file, std::string_view bytes, double memory_limit) {
    auto report = parse(bytes, memory_limit);
    if (!report) return tl::unexpected(report.error());
    const auto refuse = [](std::string sentence) {
        return core::fail(core::ErrorCode::BadSyntax, std::move(sentence));
    };
    if (!report->is_object() || !report->contains("shard"))
        return refuse("This is no report of `suite --shard --json`.");
    Reader in;
    const std::string version = in.text(*report, "loopcheck");
    const std::string checksum = in.text(in.object(*report, "shard"), "checksum");
    if (in.error()) return tl::unexpected(*in.error());
    if (version != LOOPCHECK_VERSION)
        return refuse(fmt::format("It was written by loopcheck {}; this is " LOOPCHECK_VERSION ".", version));
    seal(*report);
    if ((*report)["shard"]["checksum"] != checksum)
        return refuse("It was changed after it was written: its checksum is another.");

    ShardReport out{std::move(file), {}, {}, {}};
    const Json& shard = in.object(*report, "shard");
    out.suite.levels = in.count<int>(shard, "levels");
    out.suite.shard = read_shard_of_suite(in, shard);
    out.subjects =
        in.entries(*report, "subjects", [&](const Json& entry) { return read_subject(in, entry); });
    out.suite.unreadable =
        in.entries(*report, "unreadable", [&](const Json& entry) { return read_unreadable(in, entry); });
    out.suite.rows = in.entries(*report, "comparisons",
                                [&](const Json& entry) { return read_row(in, entry, out.subjects); });
    if (in.error()) return tl::unexpected(*in.error());
    out.comparisons = std::move((*report)["comparisons"]);
    return out;
}

tl::expected<MergedSuite, std::vector<std::string>> merge_shards(std::vector<ShardReport> shards) {
    if (auto why = why_not_all_of_one(shards); !why.empty()) return tl::unexpected(std::move(why));
    Merger merger(shards);
    if (auto error = merger.run()) return tl::unexpected(std::vector{std::move(*error)});
    Json comparisons = std::move(merger).comparisons();
    MergedSuite out{std::move(merger).suite(), std::move(shards.front().subjects), {}};
    out.json = dump(suite_document(out.suite, out.subjects, std::move(comparisons)));
    return out;
}

}  // namespace loopcheck::compare

#include "core/bspline/points_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/atomic_file.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::line;
using tests::value_of;

void expect_points(std::string_view text, int dimension, const std::vector<glm::dvec3>& points) {
    const PointsFile file = value_of(parse_points(text));
    EXPECT_EQ(file.dimension, dimension) << text;
    EXPECT_EQ(file.points, points) << text;
    EXPECT_EQ(file.lines.size(), points.size()) << text;
}

void expect_error(std::string_view text, ErrorCode code, Place place, const std::string& part) {
    const Error error = error_of(parse_points(text));
    EXPECT_EQ(error.code, code) << text;
    EXPECT_EQ(error.place, place) << text;
    EXPECT_TRUE(contains(error.sentence, part)) << text << ": " << error.sentence;
}

TEST(PointsFile, SeparatesByBlanksCommasOrSemicolons) {
    const std::vector<glm::dvec3> plane{{1, 2, 0}, {-3.5, 0.25, 0}}, space{{1, 2, 3}, {4, 5, 6}};
    expect_points("1 2\n-3.5 .25\n", 2, plane);
    expect_points("1,2\n-3.5,.25", 2, plane);
    expect_points("1;2\n-3.5;.25\n", 2, plane);
    expect_points(" \t1 \t 2\t\n\v-3.5\f25e-2", 2, plane);
    expect_points("1 , 2\n -3.5,\t+0.25 \n", 2, plane);
    expect_points("1 2 3\n4 5 6\n", 3, space);
    expect_points("1, 2, 3\n4;5;6\n", 3, space);
    expect_points("7 8", 2, {{7, 8, 0}});
}

TEST(PointsFile, SkipsCommentsEmptyLinesAndABom) {
    const std::vector<glm::dvec3> points{{1, 2, 0}, {3, 4, 0}};
    expect_points("# a curve\n\n1 2 # first\n   \n#5 6\n3 4#", 2, points);
    expect_points(
        "\xEF\xBB\xBF"
        "1 2\n3 4\n",
        2, points);
    expect_points("\xEF\xBB\xBFx,y\n1,2\n3,4\n", 2, points);
}

TEST(PointsFile, EndsLinesWithLfCrLfOrCr) {
    const std::vector<glm::dvec3> points{{1, 2, 0}, {3, 4, 0}};
    expect_points("1 2\r\n3 4\r\n", 2, points);
    expect_points("1,2\r3,4\r", 2, points);
    EXPECT_EQ(value_of(parse_points("\r\n1 2\r\n\r\n3 4\r\n")).lines, (std::vector<long long>{2, 4}));
    EXPECT_EQ(value_of(parse_points("# c\n1 2\n\n3 4")).lines, (std::vector<long long>{2, 4}));
}

TEST(PointsFile, MayNameItsColumnsInTheFirstLineWithWords) {
    const std::vector<glm::dvec3> points{{1, 2, 0}};
    for (const char* header : {"x y", "x,y", "X;Y", "x", "x,y,z", "lon , lat", "east north up", "# c\n\nx y"})
        expect_points(std::string(header) + "\n1 2\n", 2, points);
    expect_error("1 2\nx y\n", ErrorCode::BadSyntax, line(2), "'x' is not a number");
    expect_error("x y\nx y\n1 2\n", ErrorCode::BadSyntax, line(2), "'x' is not a number");
    expect_error("x 1\n1 2\n", ErrorCode::BadSyntax, line(1), "'x' is not a number");
    expect_error("a b c d\n1 2\n", ErrorCode::BadSyntax, line(1), "this line has 4");
    expect_error("x,\n1,2\n", ErrorCode::BadSyntax, line(1), "'x' is not a number");
}

TEST(PointsFile, TakesTheNearestDouble) {
    expect_points("0.1 1e-400\n9007199254740993 2.2250738585072011e-308\n", 2,
                  {{0.1, 0, 0}, {9007199254740992.0, 2.2250738585072011e-308, 0}});
    EXPECT_TRUE(std::signbit(value_of(parse_points("-0 1")).points[0].x));
}

TEST(PointsFile, RefusesBadFieldsWithTheLine) {
    expect_error("1,2,\n", ErrorCode::BadSyntax, line(1), "is missing");
    expect_error(",1\n", ErrorCode::BadSyntax, line(1), "is missing");
    expect_error("0 0\n1,,2\n", ErrorCode::BadSyntax, line(2), "has 3 coordinates, those before have 2");
    expect_error("1;2,3\n", ErrorCode::BadSyntax, line(1), "'2,3' is not a number");
    expect_error("1,5;2,5\n", ErrorCode::BadSyntax, line(1), "");
    expect_error("1 2,3\n", ErrorCode::BadSyntax, line(1), "'1 2' is not a number");
    expect_error("1 2\n0x10 1\n", ErrorCode::BadSyntax, line(2), "'0x10' is not a number");
    for (const char* bad : {"1e", "--1", "1.2.3", "1f", "+", ".", "1_000", "\"1\"", "1e+", "\xC2\xA0", "e5"})
        expect_error("1 2\n1 " + std::string(bad), ErrorCode::BadSyntax, line(2), "is not a number");
    expect_error(std::string_view("1 2\n1 \0\n", 8), ErrorCode::BadSyntax, line(2), "is not a number");
}

TEST(PointsFile, RefusesWhatIsNotFiniteWithTheLine) {
    for (const char* bad : {"nan", "inf", "-inf", "NaN", "Infinity", "1e999", "-1e400"})
        for (const char* before : {"", "x y\n", "0 0\n"}) {
            const bool first = *before == '\0';
            expect_error(std::string(before) + "1 " + bad + "\n", ErrorCode::NotFinite, line(first ? 1 : 2),
                         "is not finite");
        }
    expect_error("nan nan\n1 2\n", ErrorCode::NotFinite, line(1), "'nan' is not finite");
    expect_error("inf,inf\n", ErrorCode::NotFinite, line(1), "'inf' is not finite");
}

TEST(PointsFile, RefusesOtherNumbersOfCoordinatesWithTheLine) {
    expect_error("1\n", ErrorCode::BadSyntax, line(1), "this line has 1");
    expect_error("1 2\n\n3\n", ErrorCode::BadSyntax, line(3), "this line has 1");
    expect_error("1 2 3 4\n", ErrorCode::BadSyntax, line(1), "this line has 4");
    expect_error("1 2\n1 2 3\n", ErrorCode::BadSyntax, line(2), "has 3 coordinates, those before have 2");
    expect_error("1 2 3\n1 2\n", ErrorCode::BadSyntax, line(2), "has 2 coordinates, those before have 3");
}

TEST(PointsFile, WithoutAPointIsRefused) {
    for (const char* text : {"", "\n\n", "# nothing\n", "x y\n", "\xEF\xBB\xBF", "  \t\r\n"})
        expect_error(text, ErrorCode::TooFewPoints, tests::kNoPlace, "no point");
}

TEST(PointsFile, ShowsOnlyTheBeginningOfALongField) {
    const std::string megabyte(1 << 20, '7');
    const Error error = error_of(parse_points("1 2\n1 z" + megabyte));
    EXPECT_EQ(error.place, line(2));
    EXPECT_LT(error.sentence.size(), 100U);
    const Error many = error_of(parse_points("1 2\n" + std::string(1 << 20, ',')));
    EXPECT_TRUE(contains(many.sentence, "this line has 1048577"));
    expect_error("1 " + megabyte, ErrorCode::NotFinite, line(1), "7...' is not finite");
    expect_points("1 0." + megabyte, 2, {{1, 7.0 / 9, 0}});
}

TEST(ReadPoints, ReadsAFileAndSaysWhereItCannot) {
    const tests::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "curve.txt", "x,y\n1,2\n"));
    EXPECT_EQ(value_of(read_points(folder / "curve.txt")).points, (std::vector<glm::dvec3>{{1, 2, 0}}));
    EXPECT_EQ(error_of(read_points(folder / "none.txt")).code, ErrorCode::CannotRead);
    EXPECT_EQ(error_of(read_points(folder.path())).code, ErrorCode::CannotRead);
}

// Any bytes give points or an error with a line; meant to run under sanitizers too.
TEST(PointsFile, TakesAnyBytes) {
    const std::string_view samples[] = {"x,y\n1,2\n-3.5,0.25\r\n# end\n7e3,8\n", "1 2 3\n4 5 6 # c\n\n7 8 9",
                                        "\xEF\xBB\xBF"
                                        "a;b;c\n1;2;3\r4;5;6\r"};
    const std::string_view alphabet("0123456789+-.eExX,;# \t\r\n\0\xFFnaif\xEF\xBB\xBF", 33);
    std::mt19937_64 random(1);
    int read = 0, refused = 0;
    for (const std::string_view sample : samples)
        for (int round = 0; round < 3000; ++round) {
            std::string bytes(sample);
            for (std::uint64_t change = random() % 4 + 1; change > 0; --change) {
                const std::size_t at = random() % (bytes.size() + 1);
                const char byte = alphabet[random() % alphabet.size()];
                if (random() % 3 == 0)
                    bytes.insert(at, 1, byte);
                else if (at < bytes.size() && random() % 2 == 0)
                    bytes.erase(at, 1);
                else if (at < bytes.size())
                    bytes[at] = byte;
            }
            const auto file = parse_points(bytes);
            (file ? read : refused) += 1;
            if (!file) {
                EXPECT_TRUE(file.error().place.kind == Place::Kind::Line ||
                            file.error().code == ErrorCode::TooFewPoints);
                continue;
            }
            EXPECT_TRUE(file->dimension == 2 || file->dimension == 3);
            EXPECT_FALSE(file->points.empty());
            for (const glm::dvec3& p : file->points)
                EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
                            (file->dimension == 3 || p.z == 0));
        }
    EXPECT_GT(read, 500);
    EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace loopcheck::core

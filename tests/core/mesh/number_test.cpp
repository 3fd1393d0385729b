#include "core/mesh/io/number.h"

#include <gtest/gtest.h>
#include <locale.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "tests/support/random_doubles.h"

namespace loopcheck::core {
namespace {

using boost::multiprecision::cpp_int;
using tests::bits;
using tests::doubles_of_every_size;

/// digits * 10^exponent, exactly; the value is not negative.
struct Decimal {
    cpp_int digits;
    int exponent = 0;

    std::string text() const { return digits.str() + "e" + std::to_string(exponent); }
};

/// significand * 2^exponent, exactly.
struct Binary {
    cpp_int significand;
    int exponent = 0;
};

/// -1, 0 or 1 as the decimal is less than, equal to or greater than the binary number.
int compare(const Decimal& decimal, const Binary& binary) {
    cpp_int left = decimal.digits;
    cpp_int right = binary.significand;
    (decimal.exponent >= 0 ? left : right) *=
        pow(cpp_int(10), static_cast<unsigned>(std::abs(decimal.exponent)));
    (binary.exponent >= 0 ? right : left) <<= static_cast<unsigned>(std::abs(binary.exponent));
    return left.compare(right) < 0 ? -1 : left.compare(right) > 0 ? 1 : 0;
}

/// What a floating-point type looks like.
template <class Float>
struct Shape {
    static constexpr int kDigits = std::numeric_limits<Float>::digits;
    static constexpr int kLeast = std::numeric_limits<Float>::min_exponent - kDigits;  ///< of the last bit
};

/// A float that is not negative as an exact number.  Infinity stands for the power of two after the largest.
template <class Float>
Binary exact(Float value) {
    if (std::isinf(value)) return {1, std::numeric_limits<Float>::max_exponent};
    int exponent = 0;
    const auto fraction = static_cast<double>(std::frexp(value, &exponent));
    if (value == 0) return {0, Shape<Float>::kLeast};
    return {cpp_int(std::ldexp(fraction, Shape<Float>::kDigits)), exponent - Shape<Float>::kDigits};
}

/// The middle between a and b, a <= b.
Binary middle(const Binary& a, const Binary& b) {
    const int least = std::min(a.exponent, b.exponent);
    const cpp_int sum = (a.significand << static_cast<unsigned>(a.exponent - least)) +
                        (b.significand << static_cast<unsigned>(b.exponent - least));
    return {sum, least - 1};
}

template <class Float>
bool is_even(Float value) {
    if constexpr (sizeof(Float) == 4)
        return (std::bit_cast<std::uint32_t>(value) & 1) == 0;
    else
        return (std::bit_cast<std::uint64_t>(value) & 1) == 0;
}

/// True where `value` is the float nearest to the decimal, ties to even: checked with integers only.
template <class Float>
::testing::AssertionResult is_nearest(const Decimal& decimal, Float value) {
    constexpr Float kInfinity = std::numeric_limits<Float>::infinity();
    const bool even = is_even(value);
    if (value > 0) {
        const int below = compare(decimal, middle(exact(std::nextafter(value, Float{0})), exact(value)));
        if (below < 0 || (below == 0 && !even))
            return ::testing::AssertionFailure()
                   << decimal.text() << " is nearer to the float below " << value;
    }
    if (value < kInfinity) {
        const int above = compare(decimal, middle(exact(value), exact(std::nextafter(value, kInfinity))));
        if (above > 0 || (above == 0 && !even))
            return ::testing::AssertionFailure()
                   << decimal.text() << " is nearer to the float above " << value;
    }
    return ::testing::AssertionSuccess();
}

/// The digits of significand * 2^exponent, all of them.
Decimal expand(const Binary& binary) {
    if (binary.exponent >= 0) return {binary.significand << static_cast<unsigned>(binary.exponent), 0};
    return {binary.significand * pow(cpp_int(5), static_cast<unsigned>(-binary.exponent)), binary.exponent};
}

/// The decimal exactly in the middle of two floats, and its neighbours in the last of many digits.
template <class Float>
void expect_halfway_is_rounded(Float below, Float (*read)(const std::string&)) {
    const Float above = std::nextafter(below, std::numeric_limits<Float>::infinity());
    Decimal half = expand(middle(exact(below), exact(above)));
    EXPECT_EQ(read(half.text()), is_even(below) ? below : above) << half.text();
    half.digits *= pow(cpp_int(10), 40);
    half.exponent -= 40;
    half.digits += 1;
    EXPECT_EQ(read(half.text()), above) << half.text();
    half.digits -= 2;
    EXPECT_EQ(read(half.text()), below) << half.text();
}

double read_double(const std::string& text) {
    return parse_double(text).value_or(std::nan(""));
}
float read_float(const std::string& text) {
    return parse_float(text).value_or(std::nanf(""));
}

TEST(ParseDouble, RoundsKnownHardCases) {
    EXPECT_EQ(read_double("9007199254740993"), 9007199254740992.0);
    EXPECT_EQ(read_double("9007199254740993.00000000000000000000000000001"), 9007199254740994.0);
    EXPECT_EQ(read_double("9007199254740995"), 9007199254740996.0);
    EXPECT_EQ(bits(read_double("2.2250738585072011e-308")), 0x000FFFFFFFFFFFFFu);
    EXPECT_EQ(bits(read_double("2.2250738585072012e-308")), 0x0010000000000000u);
    EXPECT_EQ(bits(read_double("6.9294956446009195e15")), bits(6929495644600919.5));
    EXPECT_EQ(bits(read_double("1e23")), 0x44B52D02C7E14AF6u);
    EXPECT_EQ(bits(read_double("8.533e+68")), 0x4E3FA69165A8EEA2u);
    EXPECT_EQ(bits(read_double("0.1")), 0x3FB999999999999Au);
}

TEST(ParseDouble, RoundsTheEdgeOfOverflow) {
    constexpr double kMax = std::numeric_limits<double>::max();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(read_double("1.7976931348623157e308"), kMax);
    EXPECT_EQ(read_double("1.7976931348623158e308"), kMax);
    EXPECT_EQ(read_double("1.7976931348623159e308"), kInfinity);
    Decimal edge = expand(middle(exact(kMax), exact(kInfinity)));
    EXPECT_EQ(read_double(edge.digits.str()), kInfinity);
    edge.digits -= 1;
    EXPECT_EQ(read_double(edge.digits.str()), kMax);
    EXPECT_EQ(read_double("-1e999"), -kInfinity);
    EXPECT_EQ(read_double("1e999999999999999999999"), kInfinity);
}

TEST(ParseDouble, RoundsTheEdgeOfUnderflow) {
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    Decimal edge = expand(middle(exact(0.0), exact(kLeast)));
    EXPECT_EQ(bits(read_double(edge.text())), 0u);
    EXPECT_EQ(bits(read_double("-" + edge.text())), bits(-0.0));
    edge.digits += 1;
    EXPECT_EQ(read_double(edge.text()), kLeast);
    EXPECT_EQ(bits(read_double("1e-400")), 0u);
    EXPECT_EQ(bits(read_double("-1e-400")), bits(-0.0));
    EXPECT_EQ(bits(read_double("1e-999999999999999999999")), 0u);
    EXPECT_EQ(read_double("4.9e-324"), kLeast);
    EXPECT_EQ(read_double("7.4e-324"), kLeast);
    EXPECT_EQ(read_double("7.5e-324"), 2 * kLeast);
}

TEST(ParseDouble, RoundsHalfwayCasesWithHundredsOfDigits) {
    for (double value : doubles_of_every_size(400, 2)) {
        value = std::fabs(value);
        if (value < std::numeric_limits<double>::max()) expect_halfway_is_rounded<double>(value, read_double);
    }
}

TEST(ParseFloat, RoundsOnceAndNotByWayOfDouble) {
    for (const double value : doubles_of_every_size(400, 3)) {
        const auto narrow = std::bit_cast<float>(static_cast<std::uint32_t>(bits(value) >> 33));
        if (narrow < std::numeric_limits<float>::max()) expect_halfway_is_rounded<float>(narrow, read_float);
    }
}

TEST(ParseDouble, IsNearestForRandomDecimalsOfEveryExponent) {
    std::mt19937_64 random(4);
    for (int i = 0; i < 6000; ++i) {
        Decimal decimal;
        const int words = 1 + static_cast<int>(random() % 3);
        for (int k = 0; k < words; ++k) decimal.digits = (decimal.digits << 64) + random();
        decimal.digits >>= static_cast<unsigned>(random() % 60);
        const int length = static_cast<int>(decimal.digits.str().size());
        decimal.exponent = static_cast<int>(random() % 650) - 335 - length;
        const auto value = parse_double(decimal.text());
        ASSERT_TRUE(value) << decimal.text();
        ASSERT_TRUE(is_nearest(decimal, *value));
    }
}

TEST(ParseFloat, IsNearestForRandomDecimalsOfEveryExponent) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 6000; ++i) {
        Decimal decimal{random() >> (random() % 60), 0};
        decimal.exponent =
            static_cast<int>(random() % 90) - 50 - static_cast<int>(decimal.digits.str().size());
        const auto value = parse_float(decimal.text());
        ASSERT_TRUE(value) << decimal.text();
        ASSERT_TRUE(is_nearest(decimal, *value));
    }
}

TEST(ParseDouble, ReadsStringsOfManyDigits) {
    EXPECT_EQ(read_double("0." + std::string(1000, '0') + "1e1001"), 1.0);
    EXPECT_EQ(read_double(std::string(100000, '9') + "e-99999"), 10.0);
    EXPECT_EQ(read_double("1" + std::string(400, '0') + "e-400"), 1.0);
    EXPECT_EQ(read_double("1." + std::string(600, '0') + "1"), 1.0);
    EXPECT_EQ(read_double(std::string(500, '0') + "7"), 7.0);
}

TEST(ParseDouble, AcceptsEverySpelling) {
    EXPECT_EQ(read_double("+1.5"), 1.5);
    EXPECT_EQ(read_double("-.5"), -0.5);
    EXPECT_EQ(read_double("5."), 5.0);
    EXPECT_EQ(read_double("1E+2"), 100.0);
    EXPECT_EQ(bits(read_double("-0")), bits(-0.0));
    EXPECT_EQ(read_double("-Inf"), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(read_double("+infinity"), std::numeric_limits<double>::infinity());
    for (const char* text : {"nan", "NaN", "-nan", "nan(ind)"}) {
        const auto value = parse_double(text);
        EXPECT_TRUE(value && std::isnan(*value)) << text;
    }
}

TEST(ParseDouble, RefusesWhatIsNoNumber) {
    for (const char* text : {"", "+", "-", ".", "e5", "1e", "1e+", "++1", "+-1", "-+1", "1 ", " 1", "1,5",
                             "0x10", "1_0", "1.2.3", "1d5", "in", "nano"})
        EXPECT_FALSE(parse_double(text)) << text;
}

TEST(ParseDouble, DoesNotDependOnTheLocale) {
    const std::string before = setlocale(LC_ALL, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
        if (!setlocale(LC_ALL, locale)) continue;
        EXPECT_EQ(read_double("1.5"), 1.5);
        EXPECT_EQ(read_double("0.0015e312"), std::numeric_limits<double>::infinity());
        EXPECT_EQ(shortest(1.5), "1.5");
    }
    setlocale(LC_ALL, before.c_str());
}

TEST(ParseInteger, TakesASignAndRefusesWhatDoesNotFit) {
    EXPECT_EQ(parse_integer("+12"), 12);
    EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<long long>::min());
    for (const char* text : {"", "+", "-", "+-1", "1.0", "1e3", "9223372036854775808", "0x1", "1/2", " 1"})
        EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Shortest, ReadsBackToTheSameBits) {
    for (const double value : doubles_of_every_size(20000, 6)) {
        const auto back = parse_double(shortest(value));
        ASSERT_TRUE(back);
        ASSERT_EQ(bits(*back), bits(value)) << hexfloat(value);
        const auto narrow = static_cast<float>(value);
        const auto narrow_back = parse_float(shortest(narrow));
        ASSERT_TRUE(narrow_back);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(*narrow_back), std::bit_cast<std::uint32_t>(narrow));
    }
}

TEST(Shortest, HasNoMoreDigitsThanNeeded) {
    EXPECT_EQ(shortest(0.1), "0.1");
    EXPECT_EQ(shortest(-0.0), "-0");
    EXPECT_EQ(shortest(3.0), "3");
    EXPECT_EQ(shortest(5e-324), "5e-324");
    EXPECT_EQ(shortest(0.1f), "0.1");
    EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Hexfloat, ShowsEveryBit) {
    EXPECT_EQ(hexfloat(3.0), "0x1.8p+1");
    EXPECT_EQ(hexfloat(-0.1), "-0x1.999999999999ap-4");
    EXPECT_EQ(hexfloat(-0.0), "-0x0p+0");
    EXPECT_EQ(hexfloat(-std::numeric_limits<double>::infinity()), "-inf");
}

}  // namespace
}  // namespace loopcheck::core

// Writing and reading again gives the same bits, in every format.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "tests/support/random_doubles.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::bits;
using tests::doubles_of_every_size;
using tests::value_of;

/// Triangles that share no vertex, with coordinates of every size.  No two vertices are equal, so that STL
/// has nothing to merge.
Model triangles_of_every_size() {
    const std::vector<double> numbers = doubles_of_every_size(9 * 700);
    Model model;
    for (std::size_t i = 0; i + 9 <= numbers.size(); i += 9) {
        std::array<Index, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double* const p = &numbers[i + 3 * k];
            corners[k] = static_cast<Index>(model.data.positions.size());
            model.data.positions.emplace_back(p[0], p[1], p[2]);
        }
        model.data.add_face(corners);
    }
    return model;
}

struct Way {
    const char* name;
    FileFormat format;
    Encoding encoding;
};
void PrintTo(const Way& way, std::ostream* out) {
    *out << way.name;
}

class RoundTrip : public ::testing::TestWithParam<Way> {};

TEST_P(RoundTrip, KeepsEveryBitOfEveryCoordinate) {
    const Model model = triangles_of_every_size();
    const Written written = value_of(format_model(GetParam().format, model, GetParam().encoding));
    const Model back = value_of(parse_model(GetParam().format, written.bytes));
    ASSERT_EQ(back.data.positions.size(), model.data.positions.size());
    for (std::size_t v = 0; v < model.data.positions.size(); ++v)
        for (int i = 0; i < 3; ++i)
            ASSERT_EQ(bits(back.data.positions[v][i]), bits(model.data.positions[v][i]))
                << "vertex " << v << " was " << hexfloat(model.data.positions[v][i]) << " and is "
                << hexfloat(back.data.positions[v][i]);
    EXPECT_EQ(back.data.face_sizes, model.data.face_sizes);
    EXPECT_EQ(back.data.face_corners, model.data.face_corners);
}

TEST_P(RoundTrip, WritesTheSameBytesAgain) {
    Model model = triangles_of_every_size();
    model.description = "Triangles of every size";
    const Written first = value_of(format_model(GetParam().format, model, GetParam().encoding));
    const Model back = value_of(parse_model(GetParam().format, first.bytes));
    EXPECT_EQ(value_of(format_model(GetParam().format, back, GetParam().encoding)).bytes, first.bytes);
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, RoundTrip,
                         ::testing::Values(Way{"Obj", FileFormat::Obj, Encoding::Text},
                                           Way{"Off", FileFormat::Off, Encoding::Text},
                                           Way{"PlyText", FileFormat::Ply, Encoding::Text},
                                           Way{"PlyBinary", FileFormat::Ply, Encoding::Binary},
                                           Way{"Stl", FileFormat::Stl, Encoding::Text}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace loopcheck::core

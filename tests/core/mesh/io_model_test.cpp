#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/model.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::line;
using tests::TemporaryFolder;
using tests::value_of;
using Indices = std::vector<Index>;

constexpr FileFormat kFormats[] = {FileFormat::Obj, FileFormat::Off, FileFormat::Ply, FileFormat::Stl};

Model triangle() {
    Model model;
    model.data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
    model.data.add_face(Indices{0, 1, 2});
    return model;
}

TEST(FormatOf, GoesByTheExtensionInAnyCase) {
    EXPECT_EQ(value_of(format_of("a.obj")), FileFormat::Obj);
    EXPECT_EQ(value_of(format_of("/x.y/a.b.OFF")), FileFormat::Off);
    EXPECT_EQ(value_of(format_of("a.Ply")), FileFormat::Ply);
    EXPECT_EQ(value_of(format_of("a.stl")), FileFormat::Stl);
    for (const char* name : {"a", "a.", "a.objx", ".obj", "obj", "a.obj/b", ""})
        EXPECT_EQ(error_of(format_of(name)).code, ErrorCode::UnknownFormat) << name;
}

TEST(ReadModel, ReadsWhatWriteModelWrote) {
    const TemporaryFolder folder;
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
        ASSERT_TRUE(write_model(folder / name, triangle())) << name;
        const Model back = value_of(read_model(folder / name));
        EXPECT_EQ(back.data.positions, triangle().data.positions) << name;
        EXPECT_EQ(back.data.face_corners, triangle().data.face_corners) << name;
    }
}

TEST(ReadModel, SaysWhyItCannotRead) {
    const TemporaryFolder folder;
    EXPECT_EQ(error_of(read_model(folder / "missing.obj")).code, ErrorCode::CannotRead);
    EXPECT_EQ(error_of(read_model(folder / "missing.xyz")).code, ErrorCode::UnknownFormat);
}

TEST(WriteModel, LeavesTheOldFileWhereItFails) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "a.stl", "old"));
    Model square = triangle();
    square.data.add_face(Indices{0, 1, 2, 0});
    EXPECT_EQ(error_of(write_model(folder / "a.stl", square)).code, ErrorCode::Unsupported);
    EXPECT_EQ(value_of(read_file(folder / "a.stl")), "old");
    EXPECT_EQ(error_of(write_model(folder / "a.xyz", triangle())).code, ErrorCode::UnknownFormat);
    EXPECT_EQ(error_of(write_model(folder / "no" / "a.obj", triangle())).code, ErrorCode::CannotWrite);
}

TEST(FormatModel, WritesBinaryOnlyAsPly) {
    for (const FileFormat format : {FileFormat::Obj, FileFormat::Off, FileFormat::Stl})
        EXPECT_EQ(error_of(format_model(format, triangle(), Encoding::Binary)).code, ErrorCode::Unsupported);
    EXPECT_TRUE(format_model(FileFormat::Ply, triangle(), Encoding::Binary));
}

/// Every format refuses the model with that code.
void expect_refused(const Model& model, ErrorCode code, Place place = {}) {
    for (const FileFormat format : kFormats) {
        const Error error = error_of(format_model(format, model));
        EXPECT_EQ(error.code, code);
        EXPECT_EQ(error.place, place);
    }
}

TEST(FormatModel, RefusesWhatCouldNotBeReadAgain) {
    Model model = triangle();
    model.data.positions[1].y = std::numeric_limits<double>::quiet_NaN();
    expect_refused(model, ErrorCode::NotFinite, {Place::Kind::Vertex, 1});

    model = triangle();
    model.data.face_corners[2] = 3;
    expect_refused(model, ErrorCode::IndexOutOfRange, {Place::Kind::Face, 0});
    model.data.face_corners[2] = -1;
    expect_refused(model, ErrorCode::IndexOutOfRange, {Place::Kind::Face, 0});

    model = triangle();
    model.data.face_sizes[0] = 4;
    expect_refused(model, ErrorCode::IndexOutOfRange);

    model = triangle();
    model.data.creases = {{0, 3, 1}};
    expect_refused(model, ErrorCode::IndexOutOfRange);
    model.data.creases = {{0, 1, -1}};
    expect_refused(model, ErrorCode::BadSharpness);

    model = triangle();
    model.data.corners = {{-1, 1}};
    expect_refused(model, ErrorCode::IndexOutOfRange);
    model.data.corners = {{0, std::numeric_limits<float>::quiet_NaN()}};
    expect_refused(model, ErrorCode::BadSharpness);

    model = triangle();
    model.data.holes = {1};
    expect_refused(model, ErrorCode::HoleOutOfRange);
}

TEST(Locate, FindsTheLineOfAVertexOrFace) {
    const Model model = value_of(parse_model(FileFormat::Obj, "v 0 0 0\n\nv 1 0 0\nf 1 2 2\n"));
    EXPECT_EQ(model.locate({Place::Kind::Vertex, 1}), line(3));
    EXPECT_EQ(model.locate({Place::Kind::Face, 0}), line(4));
}

TEST(Locate, LeavesThePlaceWhereNoLineIsKnown) {
    const Model model = value_of(parse_model(FileFormat::Obj, "v 0 0 0\n"));
    for (const Place place : {Place{}, line(7), Place{Place::Kind::Vertex, 1}, Place{Place::Kind::Vertex, -1},
                              Place{Place::Kind::Face, 0}})
        EXPECT_EQ(model.locate(place), place);
}

}  // namespace
}  // namespace loopcheck::core

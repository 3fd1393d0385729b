// The files in models/, for tests that are made from them: a new file is a new test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/mesh/io/model.h"
#include "tests/support/meshes.h"

namespace loopcheck::tests {

/// The files of a folder in the order of their names, as text: GoogleTest cannot print a path.
inline std::vector<std::string> files_in(const std::filesystem::path& folder,
                                         const std::vector<std::string>& extensions) {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
            out.push_back(entry.path().string());
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// Whether the tests run under sanitizers: those look at memory and undefined behaviour, and need every kind
/// of input once.  The claims are tested by the same program without them.
inline bool is_short_run() {
    return std::getenv("LOOPCHECK_TEST_LEVELS") != nullptr;
}

/// Of files in a row whose names differ in a number only, the first and the last.
inline std::vector<std::string> ends_of_series(const std::vector<std::string>& files) {
    const auto without_numbers = [](std::string name) {
        std::erase_if(name, [](unsigned char c) { return std::isdigit(c) || c == '.'; });
        return name;
    };
    std::vector<std::string> out;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto goes_on_to = [&](std::size_t j) {
            return j < files.size() && without_numbers(files[i]) == without_numbers(files[j]);
        };
        if (!goes_on_to(i - 1) || !goes_on_to(i + 1)) out.push_back(files[i]);
    }
    return out;
}

/// Every mesh that must be accepted; in a short run two of a series, such as the bipyramids.
inline const std::vector<std::string>& model_files() {
    static const auto files = [] {
        auto all = files_in(LOOPCHECK_MODELS_DIR, {".obj"});
        return is_short_run() ? ends_of_series(all) : all;
    }();
    return files;
}

/// Every file that must be refused.
inline std::vector<std::string> rejected_files() {
    return files_in(LOOPCHECK_MODELS_DIR "/reject", {".obj", ".off", ".ply", ".stl"});
}

inline std::string model_path(const std::string& name) {
    return LOOPCHECK_MODELS_DIR "/" + name + ".obj";
}

/// The name of a test made from a file: GoogleTest takes letters, digits and underscores only.
inline std::string test_name(const std::string& file, bool with_extension) {
    const std::filesystem::path path(file);
    std::string name = (with_extension ? path.filename() : path.stem()).string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}
inline std::string model_test_name(const testing::TestParamInfo<std::string>& info) {
    return test_name(info.param, false);
}
inline std::string file_test_name(const testing::TestParamInfo<std::string>& info) {
    return test_name(info.param, true);
}

/// Levels to refine in tests that look at many meshes: `most`, or fewer in a short run.
inline int levels_up_to(int most) {
    return is_short_run() ? std::min(most, std::atoi(std::getenv("LOOPCHECK_TEST_LEVELS"))) : most;
}

/// A model with the rules its file asks for.
struct LoadedModel {
    std::string name;
    core::TriangleMesh mesh;
    core::SchemeOptions options;
};

/// Throws where the file is not a good mesh, which fails the test.
inline LoadedModel load_model(const std::string& file) {
    auto model = core::read_model(file);
    if (!model) throw std::runtime_error(core::to_string(model.error()));
    core::SchemeOptions options;
    options.boundary = model->boundary.value_or(options.boundary);
    options.creasing = model->creasing.value_or(options.creasing);
    return {std::filesystem::path(file).stem().string(), mesh_of(std::move(model->data)), options};
}

}  // namespace loopcheck::tests

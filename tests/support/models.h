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

/// Every mesh that must be accepted.
inline const std::vector<std::string>& model_files() {
    static const auto files = files_in(LOOPCHECK_MODELS_DIR, {".obj"});
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

/// Levels to refine in tests that look at every model: `most`, or fewer where the tests run under sanitizers.
inline int levels_up_to(int most) {
    const char* text = std::getenv("LOOPCHECK_TEST_LEVELS");
    return text == nullptr ? most : std::min(most, std::atoi(text));
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

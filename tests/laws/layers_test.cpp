// Who may include whom.  Linking alone does not notice a wrong include of a header.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

// A room and the rooms its files may include, the narrowest room first.
struct Room {
    std::string_view folder;
    std::vector<std::string_view> may_include;
};
const std::vector<Room> kRooms{
    {"core/mesh/", {"core/mesh/"}},
    {"core/loop/", {"core/loop/", "core/mesh/"}},
    {"core/bspline/", {"core/bspline/", "core/mesh/"}},
    {"reference/opensubdiv/", {"reference/opensubdiv/", "core/mesh/"}},
    {"reference/openmesh/", {"reference/openmesh/", "core/mesh/"}},
    {"reference/boost_math/", {"reference/boost_math/", "core/mesh/"}},
    {"reference/cgal/", {"reference/cgal/", "core/mesh/"}},
    {"compare/", {"compare/", "core/", "reference/"}},
    {"models/generate/", {"models/generate/"}},
    {"bench/", {"bench/", "compare/", "core/", "reference/"}},
    {"docs/", {"compare/", "core/", "reference/"}},
    {"tests/", {"tests/", "bench/", "compare/", "core/", "models/generate/", "reference/"}},
};

// Libraries that belong to some rooms only.
const std::vector<Room> kLibraries{
    {"opensubdiv/", {"reference/opensubdiv/", "tests/"}},
    {"OpenMesh/", {"reference/openmesh/", "tests/"}},
    {"boost/multiprecision/", {"core/mesh/high_precision.h", "tests/"}},
    {"boost/", {"core/bspline/", "core/loop/", "reference/boost_math/", "tests/"}},
    {"CGAL/", {"reference/cgal/"}},
    {"CLI/", {"bench/", "compare/cli/"}},
};

bool begins_with_any(std::string_view text, const std::vector<std::string_view>& beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](std::string_view beginning) { return text.starts_with(beginning); });
}

const Room* room_of(const std::vector<Room>& rooms, std::string_view path) {
    const auto found = std::find_if(rooms.begin(), rooms.end(),
                                    [&](const Room& room) { return path.starts_with(room.folder); });
    return found == rooms.end() ? nullptr : &*found;
}

// What is wrong with one include of the file `path`; empty where nothing is.
using Exists = std::function<bool(const std::string&)>;
std::string breach(const std::string& path, char bracket, const std::string& included, const Exists& exists) {
    if (bracket == '<') {
        if (room_of(kRooms, included) != nullptr && exists(included)) return "is ours and belongs in quotes";
        const Room* library = room_of(kLibraries, included);
        return library == nullptr || begins_with_any(path, library->may_include) ? ""
                                                                                 : "does not belong here";
    }
    if (fs::path(included).lexically_normal() != fs::path(included)) return "is not a plain path";
    if (!exists(included)) return "is not the path of a file, from the root";
    return begins_with_any(included, room_of(kRooms, path)->may_include) ? "" : "breaks the layers";
}

// A sentence per wrong include line of the file `path` (from the root) with this text.
std::vector<std::string> breaches(const std::string& path, const std::string& text, const Exists& exists) {
    if (room_of(kRooms, path) == nullptr) return {path + ": no rule covers this folder"};
    static const std::regex kInclude(R"re(^\s*#\s*include\b\s*(?:([<"])([^>"]*)[>"])?.*)re");
    std::vector<std::string> found;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        if (!std::regex_match(line, match, kInclude)) continue;
        const std::string wrong = match[1].matched ? breach(path, *match[1].first, match[2].str(), exists)
                                                   : "an include that names no file cannot be checked";
        if (!wrong.empty())
            found.push_back(path + ":" + std::to_string(number) + ": " + match[2].str() + " " + wrong);
    }
    return found;
}

// Every header and source under `folder`, as paths from the root.
std::vector<std::string> sources(const std::string& folder) {
    const fs::path root = LOOPCHECK_SOURCE_DIR;
    std::vector<std::string> paths;
    if (!fs::exists(root / folder)) return paths;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
            paths.push_back(entry.path().lexically_relative(root).generic_string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

bool is_file(const std::string& path) {
    return fs::is_regular_file(fs::path(LOOPCHECK_SOURCE_DIR) / path);
}

std::string text_of(const std::string& path) {
    std::ifstream file(fs::path(LOOPCHECK_SOURCE_DIR) / path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Layers, HoldInEverySource) {
    for (const std::string folder : {"bench", "compare", "core", "docs", "models", "reference", "tests"})
        for (const std::string& path : sources(folder))
            for (const std::string& sentence : breaches(path, text_of(path), is_file))
                ADD_FAILURE() << sentence;
}

TEST(Layers, AreReadFromEveryRoomThatMatters) {
    for (const std::string folder : {"core/mesh", "core/loop", "core/bspline", "reference/opensubdiv",
                                     "reference/openmesh", "reference/boost_math", "compare"})
        EXPECT_GE(sources(folder).size(), 2u) << folder;
}

TEST(Layers, AreSeenToBreak) {
    const std::string breaks = "breaks the layers";
    struct {
        std::string path, line, said;
    } const cases[]{
        {"core/mesh/a.h", "#include \"core/mesh/b.h\"", ""},
        {"core/mesh/a.h", "#include <vector>", ""},
        {"core/mesh/a.h", "// #include \"core/loop/b.h\"", ""},
        {"core/mesh/a.h", "#include \"core/loop/b.h\"", "core/mesh/a.h:2: core/loop/b.h " + breaks},
        {"core/mesh/io/a.h", "#include \"compare/b.h\"", breaks},
        {"core/loop/a.h", "#include \"core/mesh/b.h\"", ""},
        {"core/loop/a.h", "#include \"core/bspline/b.h\"", breaks},
        {"core/loop/a.h", "#include \"reference/opensubdiv/b.h\"", breaks},
        {"core/bspline/a.h", "#include \"core/loop/b.h\"", breaks},
        {"reference/opensubdiv/a.cpp", "#include \"core/mesh/b.h\"", ""},
        {"reference/opensubdiv/a.cpp", "#include \"core/loop/b.h\"", breaks},
        {"reference/opensubdiv/a.cpp", "  #  include  \"core/loop/b.h\"  // why", breaks},
        {"reference/opensubdiv/a.cpp", "#include \"reference/openmesh/b.h\"", breaks},
        {"reference/openmesh/a.cpp", "#include \"core/bspline/b.h\"", breaks},
        {"reference/cgal/a.h", "#include \"core/loop/b.h\"", breaks},
        {"reference/another/a.cpp", "", "no rule covers this folder"},
        {"compare/a.cpp", "#include \"core/loop/b.h\"", ""},
        {"compare/a.cpp", "#include \"tests/b.h\"", breaks},
        {"bench/a.cpp", "#include \"tests/b.h\"", breaks},
        {"models/generate/a.cpp", "#include \"core/mesh/b.h\"", breaks},
        {"tests/core/a.cpp", "#include \"tests/b.h\"", ""},
        {"core/mesh/a.h", "#include \"b.h\"", breaks},
        {"core/mesh/a.h", "#include \"core/mesh/missing.h\"", "is not the path of a file"},
        {"core/mesh/a.h", "#include \"core/mesh/../loop/b.h\"", "is not a plain path"},
        {"core/mesh/a.h", "#include <core/loop/b.h>", "belongs in quotes"},
        {"core/mesh/a.h", "#include MACRO", "cannot be checked"},
        {"core/loop/a.h", "#include <opensubdiv/far/b.h>", "does not belong here"},
        {"compare/a.cpp", "#include <OpenMesh/Core/b.hh>", "does not belong here"},
        {"compare/a.h", "#include <boost/b.hpp>", "does not belong here"},
        {"bench/a.cpp", "#include <CGAL/b.h>", "does not belong here"},
        {"core/mesh/high_precision.h", "#include <boost/multiprecision/b.hpp>", ""},
        {"core/loop/weights.h", "#include <boost/multiprecision/b.hpp>", "does not belong here"}};
    const auto everything_but_missing = [](const std::string& name) { return !name.ends_with("missing.h"); };
    for (const auto& [path, line, said] : cases) {
        const auto found = breaches(path, "#pragma once\n" + line + "\nint x;\n", everything_but_missing);
        ASSERT_EQ(found.size(), said.empty() ? 0u : 1u) << path << ": " << line;
        for (const std::string& sentence : found)
            EXPECT_NE(sentence.find(said), std::string::npos) << sentence;
    }
}

}  // namespace

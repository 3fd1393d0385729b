// A folder for the files of one test, removed at its end.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace loopcheck::tests {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        // mkdtemp puts six characters in the place of the X.
        std::string name = (std::filesystem::temp_directory_path() / "loopcheck-test-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("There is no temporary folder.");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

}  // namespace loopcheck::tests

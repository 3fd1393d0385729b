// Files that a reader must refuse, each wrong in one way and with the code it must get.
#pragma once

#include <string>
#include <vector>

namespace loopcheck::models {

struct Reject {
    std::string file;
    std::string code;
    std::string reason;
    /// The whole file; it says "reject: code: reason" in its first comment.
    std::string text;
};

std::vector<Reject> rejects();

}  // namespace loopcheck::models

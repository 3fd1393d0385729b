// Columns of text.
#pragma once

#include <string>
#include <vector>

namespace loopcheck::compare {

/// Columns padded to their widest cell; the first is aligned left, the others right.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace loopcheck::compare

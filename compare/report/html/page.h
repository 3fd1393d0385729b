// The HTML report: the page, which is built from compare/report/page, and the chunks that it reads.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace loopcheck::compare {

/// Why this build cannot write HTML reports, and how to get one that can, in a sentence; empty where it can.
std::string_view why_no_page();

/// The page without a report in it, made by compare/report/page/build.mjs; empty where this build has none.
std::string_view page_text();

/// A chunk and the id of its element.
struct NamedChunk {
    std::string id, text;
};

/// The page with these chunks.  Requires a build that has it.
std::string page_with(const std::vector<NamedChunk>& chunks);

/// Chunks that are numbered as they come, equal ones once.
class ChunkList {
  public:
    /// The id of the element that has this chunk.
    std::string add(std::string chunk);
    std::vector<NamedChunk> chunks() &&;

  private:
    std::map<std::string, std::size_t> number_of_;
};

}  // namespace loopcheck::compare

#include "compare/report/html/page.h"

#include <fmt/format.h>

#include <stdexcept>

namespace loopcheck::compare {
std::string page_with(const std::vector<NamedChunk>& chunks) {
    constexpr std::string_view kPlace = "<!--chunks-->";
    const std::string_view page = page_text();
    const std::size_t at = page.find(kPlace);
    if (at == std::string_view::npos) throw std::logic_error("The page has no place for its chunks.");
    std::size_t size = page.size();
    for (const NamedChunk& chunk : chunks) size += chunk.id.size() + chunk.text.size() + 70;
    std::string out;
    out.reserve(size);
    out += page.substr(0, at);
    for (const auto& [id, text] : chunks) {
        out += fmt::format("<script type=\"application/x-loopcheck\" id=\"{}\">", id);
        out += text;
        out += "</script>\n";
    }
    out += page.substr(at + kPlace.size());
    return out;
}

std::string ChunkList::add(std::string chunk) {
    return fmt::format("case-{}", number_of_.emplace(std::move(chunk), number_of_.size()).first->second);
}

std::vector<NamedChunk> ChunkList::chunks() && {
    std::vector<NamedChunk> out(number_of_.size());
    while (!number_of_.empty()) {
        auto node = number_of_.extract(number_of_.begin());
        out[node.mapped()] = {fmt::format("case-{}", node.mapped()), std::move(node.key())};
    }
    return out;
}

}  // namespace loopcheck::compare

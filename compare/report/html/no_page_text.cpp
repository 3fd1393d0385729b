#include "compare/report/html/page.h"

namespace loopcheck::compare {

std::string_view page_text() {
    return {};
}

}  // namespace loopcheck::compare

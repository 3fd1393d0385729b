#include "core/mesh/refinement.h"

namespace loopcheck::core {

std::string_view name(VertexRule rule) {
    switch (rule) {
        case VertexRule::Smooth:
            return "smooth";
        case VertexRule::Dart:
            return "dart";
        case VertexRule::Crease:
            return "crease";
        case VertexRule::Corner:
            return "corner";
    }
    return {};
}

}  // namespace loopcheck::core

#include "core/mesh/surface.h"

namespace loopcheck::core {

std::string_view name(Derivative derivative) {
    switch (derivative) {
        case Derivative::Position:
            return "position";
        case Derivative::Du:
            return "du";
        case Derivative::Dv:
            return "dv";
        case Derivative::Duu:
            return "duu";
        case Derivative::Duv:
            return "duv";
        case Derivative::Dvv:
            return "dvv";
    }
    return {};
}

}  // namespace loopcheck::core

#include "core/bspline/tensor_surface.h"

#include <fmt/format.h>

namespace loopcheck::core {

std::optional<Error> check_surface(const SurfaceShape& shape, std::size_t rows, std::size_t columns,
                                   std::size_t point_count) {
    const auto in_direction = [](std::string_view what, const CurveShape& direction, std::size_t count) {
        auto error = check_shape(direction, count);
        if (error) error->sentence = fmt::format("{}: {}", what, error->sentence);
        return error;
    };
    if (auto error = in_direction("Along the rows (u)", shape.u, columns)) return error;
    if (auto error = in_direction("Along the columns (v)", shape.v, rows)) return error;
    if (point_count % columns != 0 || point_count / columns != rows)
        return Error{ErrorCode::Unsupported,
                     fmt::format("{} rows of {} points are not {} points.", rows, columns, point_count)};
    return std::nullopt;
}

}  // namespace loopcheck::core

#include "core/bspline/limit.h"

namespace loopcheck::core {

std::vector<Rational> limit_mask(int degree, int r) {
    std::vector<Rational> knots;
    for (int k = 0; k <= degree + 1; ++k) knots.push_back(Rational(2 * k - (degree + 1), 2));
    const int m = degree / 2;
    std::vector<Rational> out;
    for (int k = -m; k <= m; ++k)
        out.push_back(basis_derivative<Rational>(knots, degree, 0, Rational(-k), r));
    return out;
}

}  // namespace loopcheck::core

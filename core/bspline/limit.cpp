#include "core/bspline/limit.h"

namespace loopcheck::core {

template <class Scalar>
std::vector<Scalar> limit_mask(int degree, int r) {
    std::vector<Rational> knots;
    for (int k = 0; k <= degree + 1; ++k) knots.push_back(Rational(2 * k - (degree + 1), 2));
    const int m = degree / 2;
    std::vector<Scalar> out;
    for (int k = -m; k <= m; ++k) {
        const Rational weight = basis_derivative<Rational>(knots, degree, 0, Rational(-k), r);
        out.push_back(numerator(weight).convert_to<Scalar>() / denominator(weight).convert_to<Scalar>());
    }
    return out;
}

template std::vector<float> limit_mask(int, int);
template std::vector<double> limit_mask(int, int);
template std::vector<HighPrecision> limit_mask(int, int);
template std::vector<Rational> limit_mask(int, int);

}  // namespace loopcheck::core

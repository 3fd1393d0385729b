#include "core/loop/tessellation/quartic_triangle.h"

namespace loopcheck::core {
namespace {

using Points15 = std::array<glm::dvec3, detail::kMonomials>;

// The place of a^i b^j c^k, whatever the degree i + j + k is.
constexpr int place(int j, int k) {
    return (j + k) * (j + k + 1) / 2 + k;
}

// One step of de Casteljau's algorithm: the points of degree `degree` become those of one less.
Points15 lowered(const Points15& points, int degree, const Barycentric& at) {
    Points15 out;
    for (int less = 0; less < degree; ++less)
        for (int k = 0; k <= less; ++k) {
            const int j = less - k;
            out[place(j, k)] = at[0] * points[place(j, k)] + at[1] * points[place(j + 1, k)] +
                               at[2] * points[place(j, k + 1)];
        }
    return out;
}

// Every blossom whose arguments go on with corners `first` and later; `b` and `c` count those used so far.
void add_blossoms(const Points15& points, int degree, int first, int b, int c, const SubTriangle& corners,
                  Points15& out) {
    if (degree == 0) {
        out[place(b, c)] = points[0];
        return;
    }
    for (int i = first; i < 3; ++i)
        add_blossoms(lowered(points, degree, corners[i]), degree - 1, i, b + (i == 1 ? 1 : 0),
                     c + (i == 2 ? 1 : 0), corners, out);
}

// 4!/(i! j! k!)
constexpr int multinomial(const detail::Monomial& m) {
    constexpr std::array factorial{1, 1, 2, 6, 24};
    return factorial[4] / (factorial[m.a] * factorial[m.b] * factorial[m.c]);
}

}  // namespace

const glm::dvec3& QuarticTriangle::corner(int i) const {
    return points[i == 0 ? place(0, 0) : i == 1 ? place(4, 0) : place(0, 4)];
}

QuarticTriangle quartic_triangle(std::span<const glm::dvec3, kPatchPoints> patch) {
    constexpr detail::PatchTable table = detail::patch_table();
    constexpr auto monomials = detail::monomials();
    QuarticTriangle out;
    for (int j = 0; j < detail::kMonomials; ++j) {
        glm::dvec3 sum(0);
        for (int p = 0; p < kPatchPoints; ++p) sum += static_cast<double>(table[p][j]) * patch[p];
        out.points[j] = sum / (12.0 * multinomial(monomials[j]));
    }
    return out;
}

QuarticTriangle restricted(const QuarticTriangle& quartic, const SubTriangle& corners) {
    QuarticTriangle out;
    add_blossoms(quartic.points, 4, 0, 0, 0, corners, out.points);
    return out;
}

}  // namespace loopcheck::core

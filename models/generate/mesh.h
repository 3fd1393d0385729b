// The mesh that the generator passes around: points, triangles and the tags of an OBJ file.
// It is not checked: the readers of the suite do that to the files.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace loopcheck::models {

using Point = std::array<double, 3>;
using Face = std::array<int, 3>;

/// Sharpness from which an edge or a vertex stays sharp for ever.
inline constexpr double kInfinite = 10;

/// Digits written after the decimal point, unless a mesh asks for others.
inline constexpr int kDecimals = 4;

/// The double nearest to the number of that many decimals, without negative zero.
inline double rounded(double value, int decimals) {
    double unit = 1;
    for (int i = 0; i < decimals; ++i) unit *= 10;
    return std::round(value * unit) / unit + 0.0;
}

struct Crease {
    int from;
    int to;
    double sharpness;
};

struct Corner {
    int vertex;
    double sharpness;
};

enum class InterpolateBoundary { None = 0, EdgeAndCorner = 1, EdgeOnly = 2 };

enum class CreaseMethod { Uniform, Chaikin };

struct Mesh {
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<Crease> creases = {};
    std::vector<Corner> corners = {};
    std::vector<int> holes = {};
    std::optional<InterpolateBoundary> interpolate_boundary = {};
    CreaseMethod crease_method = CreaseMethod::Uniform;
    int decimals = kDecimals;
};

/// A mesh with the name of its file and the reason why it exists.
struct Model {
    std::string name;
    std::string purpose;
    Mesh mesh;
};

}  // namespace loopcheck::models

// Box modelling: a body lofted through cross-sections, and limbs extruded from its quads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "models/generate/mesh.h"

namespace loopcheck::models {

using Quad = std::array<int, 4>;

struct QuadMesh {
    std::vector<Point> points;
    std::vector<Quad> quads;
};

/// The frame of a cross-section: `left` and `up` are its half width and half height, and
/// `left` x `up` points ahead, out of the solid.
struct Section {
    Point centre;
    Point left;
    Point up;
};

/// The section whose normal is `ahead` and whose `up` leans towards `top`.
Section section(const Point& centre, const Point& ahead, const Point& top, double half_width,
                double half_height);

/// Corners of a lofted section.
inline constexpr int kRingSize = 8;

/// The strips of a loft, between corner i and i + 1 of its sections.
enum class Strip { Top, RightShoulder, RightFlank, RightBelly, Belly, LeftBelly, LeftFlank, LeftShoulder };

/// A solid through the sections, from the rear to the front, closed by three quads at either end.
QuadMesh loft(std::span<const Section> sections);

/// The quad of a strip between section `segment` and the next one.
int strip_quad(int segment, Strip strip);

/// The corners of a section of a loft, as a closed path.
std::vector<int> ring_path(int ring);

/// The uppermost quad of the rear end.
int rear_top_quad(int section_count);

/// The sections of a limb through the points, each across the line from the point before to the one after.
struct Station {
    Point centre;
    double half_width;
    double half_height;
};
std::vector<Section> sections_along(std::span<const Station> stations, const Point& top);

/// Pulls the quad out to the section, with four new quads around it; the quad keeps its index.
void extrude(QuadMesh& mesh, int quad, const Section& to);

/// Extrudes through all sections, one after another.
void grow(QuadMesh& mesh, int quad, std::span<const Section> sections);

/// Each quad split along its shorter diagonal, coordinates rounded.
Mesh triangulated(const QuadMesh& mesh);

}  // namespace loopcheck::models

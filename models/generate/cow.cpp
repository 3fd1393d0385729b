// The cow: a trunk lofted from the rump to the muzzle, then what grows out of it. One unit is about a
// metre. Thin parts are thicker than they should look, because subdivision shrinks them.
#include "models/generate/cow.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "models/generate/box_model.h"
#include "models/generate/tags.h"

namespace loopcheck::models {
namespace {

constexpr Point kForward = {1, 0, 0};
constexpr Point kUp = {0, 1, 0};
constexpr Point kDown = {0, -1, 0};

constexpr double kRight = 1;
constexpr double kLeft = -1;

/// A cross-section of the trunk. It faces `pitch` degrees above the ground and `yaw` to its right.
struct Slice {
    Point centre;
    double pitch;
    double yaw;
    double half_width;
    double half_height;
};

constexpr auto kTrunk = std::to_array<Slice>({
    {{-1.14, 1.20, 0.00}, 8, 0, 0.24, 0.26},    // rump
    {{-1.02, 1.12, 0.00}, 0, 0, 0.41, 0.44},    // hips
    {{-0.60, 1.09, 0.00}, 0, 0, 0.46, 0.47},    // loin; the hind legs grow before it
    {{-0.14, 1.01, 0.00}, 0, 0, 0.54, 0.51},    // belly
    {{0.32, 1.03, 0.00}, 0, 0, 0.48, 0.52},     // ribs
    {{0.70, 1.10, 0.00}, 4, 0, 0.40, 0.54},     // shoulders; the forelegs grow before them
    {{0.98, 1.20, 0.01}, 22, 4, 0.30, 0.47},    // chest
    {{1.22, 1.36, 0.05}, 30, 14, 0.22, 0.37},   // neck
    {{1.42, 1.55, 0.11}, 8, 26, 0.22, 0.28},    // poll
    {{1.60, 1.57, 0.20}, -25, 34, 0.25, 0.26},  // brow
    {{1.81, 1.41, 0.35}, -40, 38, 0.17, 0.20},  // nose
    {{1.96, 1.24, 0.47}, -42, 40, 0.22, 0.19},  // muzzle
    {{2.05, 1.15, 0.54}, -42, 40, 0.19, 0.15},  // lips
});

// Segments of the trunk that something grows out of.
constexpr int kHindSegment = 1;
constexpr int kUdderSegment = 2;
constexpr int kForeSegment = 4;
constexpr int kHeadSegment = 8;
constexpr std::size_t kPoll = 8;

Point ahead(const Slice& slice) {
    constexpr double kDegree = std::numbers::pi / 180;
    const double pitch = slice.pitch * kDegree, yaw = slice.yaw * kDegree;
    return {std::cos(pitch) * std::cos(yaw), std::sin(pitch), std::cos(pitch) * std::sin(yaw)};
}

QuadMesh trunk() {
    std::vector<Section> sections;
    for (const Slice& slice : kTrunk) {
        sections.push_back(section(slice.centre, ahead(slice), kUp, slice.half_width, slice.half_height));
    }
    return loft(sections);
}

/// A level cross-section of a leg; x counts from the hip or the shoulder, z from the middle.
struct LegSlice {
    double x, y, z;
    double half_length;
    double half_width;
};

constexpr auto kHindLeg = std::to_array<LegSlice>({
    {-0.02, 0.54, 0.33, 0.19, 0.115},
    {-0.13, 0.36, 0.28, 0.10, 0.085},
    {-0.05, 0.14, 0.27, 0.07, 0.07},
    {-0.02, 0.08, 0.27, 0.105, 0.095},
    {0.00, -0.03, 0.27, 0.13, 0.12},
});

constexpr auto kForeLeg = std::to_array<LegSlice>({
    {0.00, 0.38, 0.27, 0.10, 0.095},
    {-0.01, 0.14, 0.25, 0.07, 0.07},
    {0.02, 0.08, 0.25, 0.105, 0.095},
    {0.04, -0.03, 0.25, 0.13, 0.12},
});

/// Where a leg grows and how it steps: `stride` is how far its hoof stands before the hip.
struct Leg {
    int quad;
    std::span<const LegSlice> slices;
    double hip;
    double side;
    double stride;
};

constexpr double kHip = -0.80;
constexpr double kShoulder = 0.50;

const std::array<Leg, 4> kLegs = {
    Leg{strip_quad(kHindSegment, Strip::RightBelly), kHindLeg, kHip, kRight, -0.14},
    Leg{strip_quad(kHindSegment, Strip::LeftBelly), kHindLeg, kHip, kLeft, 0.18},
    Leg{strip_quad(kForeSegment, Strip::RightBelly), kForeLeg, kShoulder, kRight, 0.17},
    Leg{strip_quad(kForeSegment, Strip::LeftBelly), kForeLeg, kShoulder, kLeft, -0.16}};

void grow_leg(QuadMesh& mesh, const Leg& leg) {
    constexpr double kHipHeight = 0.8;
    for (const auto& [x, y, z, half_length, half_width] : leg.slices) {
        const Point centre = {leg.hip + x + leg.stride * (1 - y / kHipHeight), y, leg.side * z};
        extrude(mesh, leg.quad, section(centre, kDown, kForward, half_width, half_length));
    }
}

/// A place on the head: ahead of the poll, above it, and to the side.
Point on_head(const Point& place) {
    const Slice& poll = kTrunk[kPoll];
    const Point forward = ahead({{}, 0, kTrunk[kPoll + 1].yaw, 0, 0});
    const Point right = {-forward[2], 0, forward[0]};
    Point point = poll.centre;
    for (std::size_t i = 0; i < 3; ++i) {
        point[i] += place[0] * forward[i] + place[1] * kUp[i] + place[2] * right[i];
    }
    return point;
}

/// Stations placed on the head, on one of its sides.
std::vector<Station> on_head(std::span<const Station> stations, double side) {
    std::vector<Station> placed(stations.begin(), stations.end());
    for (Station& station : placed) {
        station.centre[2] *= side;
        station.centre = on_head(station.centre);
    }
    return placed;
}

constexpr auto kHorn = std::to_array<Station>({
    {{0.12, 0.34, 0.31}, 0.065, 0.065},
    {{0.20, 0.52, 0.28}, 0.03, 0.03},
});

constexpr auto kEar = std::to_array<Station>({
    {{0.04, 0.03, 0.33}, 0.06, 0.06},
    {{0.00, 0.01, 0.47}, 0.13, 0.06},
    {{-0.04, -0.08, 0.66}, 0.05, 0.03},
});

void grow_on_head(QuadMesh& mesh, Strip strip, std::span<const Station> stations, double side,
                  const Point& top) {
    grow(mesh, strip_quad(kHeadSegment, strip), sections_along(on_head(stations, side), top));
}

/// Hangs behind the hind legs and swings to the left.
constexpr auto kTail = std::to_array<Station>({
    {{-1.28, 1.34, 0.00}, 0.075, 0.075},
    {{-1.37, 0.98, -0.06}, 0.05, 0.05},
    {{-1.37, 0.60, -0.14}, 0.105, 0.105},
    {{-1.41, 0.34, -0.20}, 0.04, 0.04},
});

constexpr auto kUdder = std::to_array<Station>({
    {{-0.38, 0.42, 0.00}, 0.15, 0.17},
    {{-0.36, 0.33, 0.00}, 0.09, 0.11},
});

QuadMesh quad_cow() {
    QuadMesh mesh = trunk();
    for (const Leg& leg : kLegs) grow_leg(mesh, leg);
    grow_on_head(mesh, Strip::RightShoulder, kHorn, kRight, kForward);
    grow_on_head(mesh, Strip::LeftShoulder, kHorn, kLeft, kForward);
    grow_on_head(mesh, Strip::RightFlank, kEar, kRight, kUp);
    grow_on_head(mesh, Strip::LeftFlank, kEar, kLeft, kUp);
    grow(mesh, rear_top_quad(static_cast<int>(kTrunk.size())), sections_along(kTail, kForward));
    grow(mesh, strip_quad(kUdderSegment, Strip::Belly), sections_along(kUdder, kForward));
    return mesh;
}

}  // namespace

Mesh cow() {
    return triangulated(quad_cow());
}

Mesh cow_with_creases() {
    constexpr double kMuzzleSharpness = 1.3;
    const QuadMesh quads = quad_cow();
    Mesh mesh = triangulated(quads);
    for (const Leg& leg : kLegs) {
        const auto& [a, b, c, d] = quads.quads[static_cast<std::size_t>(leg.quad)];
        mesh = with_crease(std::move(mesh), {a, b, c, d, a}, kInfinite);
    }
    return with_crease(std::move(mesh), ring_path(static_cast<int>(kTrunk.size()) - 1), kMuzzleSharpness);
}

}  // namespace loopcheck::models

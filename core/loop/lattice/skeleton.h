// What patches are hung into: the points on the vertices and edges of the control mesh, at every level.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/loop/lattice/quad.h"
#include "core/loop/lattice/source.h"
#include "core/mesh/point.h"

namespace loopcheck::core {

/// The points on edges at levels 1 to `levels`: 2^l + 1 an edge and level, ends included, from its end 0 to
/// its end 1.  Fans write the ends and their nearest points, strips what is between.
template <class Real>
class EdgePoints {
  public:
    explicit EdgePoints(int levels) : levels_(levels), per_edge_(first_of(levels + 1)) {}

    /// Holds edges 0 to `edge_count` - 1, or `edges` of them.  The points are not initialized.
    void hold_all(Index edge_count);
    void hold(std::span<const Index> edges, Index edge_count);

    int levels() const { return levels_; }
    bool holds_all() const { return slots_.empty(); }
    Real* at(Index edge, int level, Index point) { return reals_.get() + place_of(edge, level, point); }
    const Real* at(Index edge, int level, Index point) const {
        return reals_.get() + place_of(edge, level, point);
    }
    /// The point next to end 0 or 1.
    Real* near(Index edge, int level, int end) {
        return at(edge, level, end == 0 ? 1 : (Index{1} << level) - 1);
    }

  private:
    // 3 + 5 + 9 + ... before a level.
    static std::ptrdiff_t first_of(int level) { return (std::ptrdiff_t{1} << level) + level - 3; }
    std::ptrdiff_t place_of(Index edge, int level, Index point) const {
        const Index slot = slots_.empty() ? edge : slots_[edge];
        return kPacked * (slot * per_edge_ + first_of(level) + point);
    }
    void make_room(std::size_t edges);

    int levels_;
    std::ptrdiff_t per_edge_;
    std::size_t room_ = 0;
    std::unique_ptr<Real[]> reals_;
    std::vector<Index> slots_;  // by edge; empty: every edge has its own number
};

/// A control vertex and the nearest point on each edge around it pass through the levels by themselves.
template <class Real>
class Fan {
  public:
    explicit Fan(const LatticeSource<Real>& source) : source_(source) {}

    /// To `level`; stores what it finds of the levels that `points` has.
    void run(Index v, int level, EdgePoints<Real>& points);

    /// At the level that was run to.
    const PaddedPoint<Real>& centre() const { return centre_; }
    /// Point i is on edge i of the ring; where `points` has that level.
    std::span<const PaddedPoint<Real>> ring() const { return {ring_.data() + 1, edges_.size()}; }

  private:
    void start(Index v);
    void step(int level, bool with_ring);
    void store(int level, EdgePoints<Real>& points) const;
    PaddedPoint<Real> vertex_point(int level);
    Quad<Real> edge_point(int level, std::size_t i) const;
    void close_ring();

    const LatticeSource<Real>& source_;
    Index vertex_ = 0;
    std::span<const Index> edges_;
    std::vector<int> ends_;  // of which edge the vertex is end 0, of which end 1
    PaddedPoint<Real> centre_;
    std::vector<PaddedPoint<Real>> ring_,
        next_ring_;  // the last point stands before the first as well, and the first after the last
    std::vector<float> sharp_, child_sharp_;
};

/// The points of a control edge and, in each of its faces, the nearest row of points beside it pass through
/// the levels by themselves, given the fans at the corners of its faces.
template <class Real>
class Strip {
  public:
    explicit Strip(const LatticeSource<Real>& source) : source_(source) {}

    /// As `Fan::run`; `points` has at least the levels before `level`.
    void run(Index e, int level, EdgePoints<Real>& points);

    /// At the level that was run to, from end 0 to end 1.  The ends are there where `points` has that level.
    std::span<const PaddedPoint<Real>> edge() const { return {edge_.data(), edge_.size()}; }
    /// Neighbour `place` of point i of the edge there, counter-clockwise from the next point of the edge on,
    /// or the point itself.
    static constexpr int kSelf = -1;
    const PaddedPoint<Real>& neighbour(Index i, int place) const {
        switch (place) {
            case kSelf:
                return edge_[i];
            case 0:
                return edge_[i + 1];
            case 1:
                return rows_[0][i];
            case 2:
                return rows_[0][i - 1];
            case 3:
                return edge_[i - 1];
            case 4:
                return rows_[1][i - 1];
            default:
                return rows_[1][i];
        }
    }

  private:
    void find_arms();
    void take_control();
    void take(int level, EdgePoints<Real>& points);
    void step(int level, EdgePoints<Real>& points);
    void vertex_points(int level, Index segments);
    void edge_points(int level, Index segments);
    void advance_row(int side, int level, EdgePoints<Real>& points);

    const LatticeSource<Real>& source_;
    Index edge_number_ = 0;
    int sides_ = 2;
    // The edges that meet the ends of this one in each of its faces, and which end of theirs that is.
    struct Arm {
        Index edge;
        int end;
    };
    std::array<std::array<Arm, 2>, 2> arms_{};  // by side, then by end
    PaddedPoints<Real> edge_, next_;
    std::array<PaddedPoints<Real>, 2> rows_;
    PaddedPoints<Real> spare_;
};

}  // namespace loopcheck::core

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

/// Packed points of some vertices or edges, so many each, not initialized.
template <class Real>
class PointStore {
  public:
    /// Holds those of items 0 to `count` - 1.
    void hold_all(Index count, std::ptrdiff_t points_each);
    /// Holds those of `items`, which are less than `count`.
    void hold(std::span<const Index> items, Index count, std::ptrdiff_t points_each);

    Real* at(Index item, std::ptrdiff_t point) { return reals_.get() + place_of(item, point); }
    const Real* at(Index item, std::ptrdiff_t point) const { return reals_.get() + place_of(item, point); }

  private:
    std::ptrdiff_t place_of(Index item, std::ptrdiff_t point) const {
        const Index slot = slots_.empty() ? item : slots_[item];
        return kPacked * (slot * points_each_ + point);
    }
    void make_room(std::size_t items);

    std::ptrdiff_t points_each_ = 0;
    std::size_t room_ = 0;
    std::unique_ptr<Real[]> reals_;
    std::vector<Index> slots_;  // by item; empty: every item has its own number
};

/// What fans find at levels 1 to `levels`: control vertices, and next to them the nearest points of edges.
template <class Real>
class FanPoints {
  public:
    explicit FanPoints(int levels) : levels_(levels) {}
    void hold_all(const Topology& topology);
    void hold(std::span<const Index> vertices, std::span<const Index> edges, const Topology& topology);

    int levels() const { return levels_; }
    Real* vertex(Index v, int level) { return vertices_.at(v, level - 1); }
    const Real* vertex(Index v, int level) const { return vertices_.at(v, level - 1); }
    /// The point of an edge that is next to its end 0 or 1.
    Real* next_to(Index edge, int end, int level) { return edges_.at(edge, end * levels_ + level - 1); }
    const Real* next_to(Index edge, int end, int level) const {
        return edges_.at(edge, end * levels_ + level - 1);
    }

  private:
    int levels_;
    PointStore<Real> vertices_, edges_;
};

/// What strips find at levels 1 to `levels`: 2^l + 1 points an edge and level, from its end 0 to its end 1.
template <class Real>
class EdgePoints {
  public:
    explicit EdgePoints(int levels) : levels_(levels) {}
    void hold_all(const Topology& topology) {
        points_.hold_all(topology.edge_count(), first_of(levels_ + 1));
    }
    void hold(std::span<const Index> edges, const Topology& topology) {
        points_.hold(edges, topology.edge_count(), first_of(levels_ + 1));
    }

    int levels() const { return levels_; }
    Real* at(Index edge, int level, Index point) { return points_.at(edge, first_of(level) + point); }
    const Real* at(Index edge, int level, Index point) const {
        return points_.at(edge, first_of(level) + point);
    }

  private:
    // 3 + 5 + 9 + ... before a level.
    static std::ptrdiff_t first_of(int level) { return (std::ptrdiff_t{1} << level) + level - 3; }

    int levels_;
    PointStore<Real> points_;
};

/// A control vertex and the nearest point on each edge around it pass through the levels by themselves.
template <class Real>
class Fan {
  public:
    explicit Fan(const LatticeSource<Real>& source) : source_(source) {}

    /// To `level`; stores what it finds of the levels that `points` has.
    void run(Index v, int level, FanPoints<Real>& points);

    /// At the level that was run to.
    const PaddedPoint<Real>& centre() const { return centre_; }
    /// Point i is on edge i of the ring; where `points` has that level.
    std::span<const PaddedPoint<Real>> ring() const { return {ring_.data() + 1, edges_.size()}; }

  private:
    void start(Index v);
    void step(int level, bool with_ring);
    void store(int level, FanPoints<Real>& points) const;
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

    /// To `level`; stores what it finds of the levels that `points` has.  `fans` has the same, and at least
    /// those before `level`.
    void run(Index e, int level, const FanPoints<Real>& fans, EdgePoints<Real>& points);

    /// At the level that was run to, from end 0 to end 1.  The ends are there where `fans` has that level.
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
    void take_level_1(const FanPoints<Real>& fans);
    void step(int level, const FanPoints<Real>& fans);
    void store(int level, EdgePoints<Real>& points) const;
    void vertex_points(int level, Index segments);
    void edge_points(int level, Index segments);
    void advance_row(int side, int level, const FanPoints<Real>& fans);

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

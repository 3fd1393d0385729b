// The numbers of `split` for whole faces at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/loop/lattice/address.h"

namespace loopcheck::core {

/// What the numbers of `SplitOrder` at level L have in common on all meshes.
///
/// Let s and t be the least and the greatest power of two in i, j and i + j.  Point (i, j) inside a face was
/// born at level L - s, in the middle of an edge that came to be inside the face at level L - t.  From the
/// middle to the edge and from it to face f every step is linear, so the number is
///
///     first(s, t) + step(s, t) f + offset(i, j),
///
/// and only `first` depends on the mesh.  In the same way point i on edge e, with s the power of two in i,
/// has the number first(s) + 2^(L - s - 1) e + offset(i).
class NumberPattern {
  public:
    /// Takes 5 bytes a point.  Requires 0 <= level <= 15.
    explicit NumberPattern(int level);

    int level() const { return level_; }

    /// Bytes of the pattern of a level.
    static double bytes(int level);

  private:
    friend class SplitNumbers;

    int level_;
    std::vector<Index> inside_;               // offset(i, j), row by row
    std::vector<std::uint8_t> inside_class_;  // of (s, t)
    std::vector<Index> edge_;                 // offset(i)
};

/// The numbers of one mesh.
class SplitNumbers {
  public:
    /// Refers to both.  Requires vertices of level L that an Index can number.
    SplitNumbers(const NumberPattern& pattern, const Topology& topology);

    /// The numbers of the closed lattice of face f, by `lattice_place`.  Requires room for all its points.
    void of_face(Index f, std::span<Index> numbers) const;

  private:
    // What makes a number of a face or an edge, for a class of points.
    struct Line {
        std::int64_t first, step;

        Index at(Index of) const { return static_cast<Index>(first + step * of); }
    };

    const NumberPattern& pattern_;
    const Topology& topology_;
    std::vector<Line> inside_, edge_;
};

}  // namespace loopcheck::core

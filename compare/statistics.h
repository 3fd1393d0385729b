// Verdicts, and the statistics of errors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// How two results agree, best first.
enum class Verdict : std::uint8_t {
    Identical,       ///< every coordinate has the same bits
    WithinRounding,  ///< |a - b| <= E_a + E_b in every coordinate: no difference between the masks is shown
    KnownDeviation,  ///< differs, in a way that is on the list of known deviations and by the predicted
                     ///< amount
    NotSupported,    ///< a subject says that it cannot do this; nothing was compared
    Differs,         ///< the masks, the rules or the topology differ
    Failed,          ///< a subject gave an error or broke its promise
};
std::string_view name(Verdict verdict);

/// The process exit code for a verdict: 0 agree, 1 differ, 3 a subject failed or was asked for what it cannot
/// do.
int exit_code(Verdict verdict);

/// The exit code of several runs: 2 before 3 before 1 before 0.
int worse_exit_code(int a, int b);

/// The unit in which errors are given: u M, with the larger u of the two precisions, and at least its
/// smallest subnormal number.
double error_unit(double largest_coordinate, core::Precision a, core::Precision b);

/// Errors of many vertices.  An error is the largest coordinate of |a - b|, in model units.
struct ErrorStats {
    std::size_t count = 0;
    std::size_t identical = 0;  ///< vertices with the same bits in all coordinates
    std::size_t not_finite =
        0;  ///< vertices where an error is NaN or infinite: in `count`, not in what follows
    double max = 0;
    double sum = 0;
    double norm = 0;  ///< square root of the sum of squares

    void add(double error, bool same_bits);
    void add(const ErrorStats& other);
    double mean() const;
    double rms() const;
};

/// Statistics of one vertex class.
struct ClassStats {
    ErrorStats difference;         ///< subject against reference
    ErrorStats subject_error;      ///< subject against the exact rules
    ErrorStats reference_error;    ///< reference against the exact rules
    double largest_bound_use = 0;  ///< max of |a - b| / (E_a + E_b): above 1 the masks differ
    double largest_bound = 0;      ///< max of E_a + E_b
    double predicted = 0;  ///< largest difference between the exact results of the two subjects' rules
    std::size_t beyond_bound = 0;   ///< vertices that violate the bound
    std::size_t unexplained = 0;    ///< vertices whose difference is not the predicted one, within the bound
    std::size_t subject_wrong = 0;  ///< vertices where the subject is farther from the exact rules than E_a
    std::size_t reference_wrong = 0;  ///< and the reference than E_b
    std::size_t rule_mismatches =
        0;  ///< vertices for which a subject reports another rule or boundary tag than ours

    void add(const ClassStats& other);
};

/// How far a point is from another, and whether it may be.
struct PointDifference {
    double error = 0;          ///< largest coordinate of |a - b|; infinite where one is not finite
    double bound = 0;          ///< what is allowed in the coordinate that uses most of it
    double bound_use = 0;      ///< largest |a - b| / allowed; infinite where an error is not finite
    bool identical = false;    ///< the same bits
    bool as_predicted = true;  ///< a - b is `predicted`, within `allowed`, in every coordinate
};
PointDifference difference_between(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& allowed,
                                   const glm::dvec3& predicted);

/// The largest coordinate of a vector of magnitudes; NaN and infinity count as infinite.
double largest(const glm::dvec3& magnitudes);

/// True where every coordinate of `magnitudes` is at most that of `bound`; NaN is not.
bool is_within(const glm::dvec3& magnitudes, const glm::dvec3& bound);

/// True where all coordinates have the same bits.
bool same_bits(const glm::dvec3& a, const glm::dvec3& b);

/// How much of the allowed difference is used: above 1 it is violated.  Exact agreement uses nothing, even of
/// nothing.
double use_of(double difference, double allowed);

/// Keeps the `top` worst records seen so far, as a heap whose front is the least bad of them; `worse` orders.
template <class Record, class Worse>
void keep_worst(std::vector<Record>& heap, const Record& record, std::size_t top, Worse worse) {
    if (heap.size() >= top && (top == 0 || !worse(record, heap.front()))) return;
    heap.push_back(record);
    std::push_heap(heap.begin(), heap.end(), worse);
    if (heap.size() > top) {
        std::pop_heap(heap.begin(), heap.end(), worse);
        heap.pop_back();
    }
}

}  // namespace loopcheck::compare

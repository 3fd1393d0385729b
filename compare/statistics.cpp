#include "compare/statistics.h"

#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "core/loop/error_bound.h"

namespace loopcheck::compare {
namespace {

using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double largest(const dvec3& v) {
    double out = 0;
    for (int i = 0; i < 3; ++i)
        if (!(v[i] <= out)) out = std::isfinite(v[i]) ? v[i] : kInfinity;
    return out;
}

bool same_bits(const dvec3& a, const dvec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    return true;
}

double use_of(double difference, double allowed) {
    if (!std::isfinite(difference)) return kInfinity;
    if (difference == 0) return 0;
    return allowed > 0 ? difference / allowed : kInfinity;
}

bool is_within(const dvec3& magnitudes, const dvec3& bound) {
    return magnitudes.x <= bound.x && magnitudes.y <= bound.y && magnitudes.z <= bound.z;
}

PointDifference difference_between(const dvec3& a, const dvec3& b, const dvec3& allowed,
                                   const dvec3& predicted) {
    PointDifference out;
    const dvec3 signed_difference = a - b;
    const dvec3 difference = glm::abs(signed_difference);
    out.identical = same_bits(a, b);
    out.error = largest(difference);
    for (int i = 0; i < 3; ++i) {
        const double use = use_of(difference[i], allowed[i]);
        if (i == 0 || use > out.bound_use) {
            out.bound = allowed[i];
            out.bound_use = use;
        }
        // The predicted difference of two doubles is itself rounded once more.
        const double slack = allowed[i] + std::abs(predicted[i]) * 0x1p-51;
        out.as_predicted = out.as_predicted && std::abs(signed_difference[i] - predicted[i]) <= slack;
    }
    return out;
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::Identical:
            return "identical";
        case Verdict::WithinRounding:
            return "within rounding";
        case Verdict::KnownDeviation:
            return "known deviation";
        case Verdict::NotSupported:
            return "not supported";
        case Verdict::Differs:
            return "differs";
        case Verdict::Failed:
            return "failed";
    }
    return {};
}

int exit_code(Verdict verdict) {
    switch (verdict) {
        case Verdict::Identical:
        case Verdict::WithinRounding:
        case Verdict::KnownDeviation:
            return 0;
        case Verdict::Differs:
            return 1;
        case Verdict::NotSupported:
        case Verdict::Failed:
            return 3;
    }
    return 3;
}

int worse_exit_code(int a, int b) {
    constexpr std::array kWorstFirst{2, 3, 1, 0};
    for (const int code : kWorstFirst)
        if (a == code || b == code) return code;
    return a;
}

double error_unit(double largest_coordinate, core::Precision a, core::Precision b) {
    const auto unit = [&](core::Precision p) {
        return std::max(largest_coordinate * core::unit_roundoff(p), core::smallest_subnormal(p));
    };
    return std::max(unit(a), unit(b));
}

void ErrorStats::add(double error, bool same) {
    ++count;
    if (same) ++identical;
    if (!std::isfinite(error)) {
        ++not_finite;
        return;
    }
    max = std::max(max, error);
    sum += error;
    norm = std::hypot(norm, error);
}

void ErrorStats::add(const ErrorStats& other) {
    count += other.count;
    identical += other.identical;
    not_finite += other.not_finite;
    max = std::max(max, other.max);
    sum += other.sum;
    norm = std::hypot(norm, other.norm);
}

double ErrorStats::mean() const {
    return count > not_finite ? sum / static_cast<double>(count - not_finite) : 0;
}

double ErrorStats::rms() const {
    return count > not_finite ? norm / std::sqrt(static_cast<double>(count - not_finite)) : 0;
}

void ClassStats::add(const ClassStats& other) {
    difference.add(other.difference);
    subject_error.add(other.subject_error);
    reference_error.add(other.reference_error);
    largest_bound_use = std::max(largest_bound_use, other.largest_bound_use);
    largest_bound = std::max(largest_bound, other.largest_bound);
    predicted = std::max(predicted, other.predicted);
    beyond_bound += other.beyond_bound;
    unexplained += other.unexplained;
    subject_wrong += other.subject_wrong;
    reference_wrong += other.reference_wrong;
    rule_mismatches += other.rule_mismatches;
}

}  // namespace loopcheck::compare

// A comparison in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/comparison.h"
#include "compare/deviations.h"
#include "compare/loading.h"

namespace loopcheck::compare {

/// The verdict as sentences: what was found, where, by how much, whether it was to be expected from the rules
/// of the two sides, and which of the two is right.
std::vector<std::string> verdict_in_words(const Comparison& comparison,
                                          const core::SchemeOptions& subject_rules,
                                          const core::SchemeOptions& reference_rules);

/// "agree" for every verdict that is one, else its name.
std::string_view agreement_in_words(Verdict verdict);

/// The sentence for a known deviation that shows as predicted.  `predicted` was compared with the rules as
/// done.
std::string deviation_in_words(const KnownDeviation& deviation, const Comparison& predicted);

/// What was tagged: "--crease-angle 60: 123 edges tagged as creases".
std::string creases_in_words(const CreaseTags& creases);

/// Where a vertex comes from: "vertex point of 17", "edge point of face 3 edge 1".
std::string ancestry_in_words(const VertexRecord& record);

/// The rule that made it: "vertex point, crease".
std::string rule_in_words(const VertexRecord& record);

/// A position after a name, as decimals and as hexadecimal fractions.
std::string position_in_words(std::string_view who, const glm::dvec3& p);

/// A name from outside for a terminal: control characters become '?'.
std::string printable(std::string name);

/// An error in u M, or in model units where M is not known: "0.42 u M".
std::string in_units(double error, double unit);

}  // namespace loopcheck::compare

// Models by name, subjects that cheat (what the referee must see through), and runs of the program.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/loading.h"
#include "compare/referee.h"
#include "compare/subject.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare::test {

/// The mesh of models/NAME.obj; stops the test program where it cannot be read.
core::TriangleMesh model_mesh(const std::string& name);

/// The path of models/NAME.obj.
std::string model_path(const std::string& name);

/// Ours, with its result changed afterwards.
using Spoil = std::function<void(core::Refinement&)>;
Subject cheat(const std::string& name, Spoil spoil);

/// Ours, asked for other rules than the referee was.
Subject cheat_rules(const std::string& name, std::function<void(core::SchemeOptions&)> change);

/// Ours, refining right, with its limits changed afterwards; `refined` is what it refined.
using SpoilLimits = std::function<void(core::Limits& limits, const core::Refinement& refined)>;
Subject cheat_limits(const std::string& name, SpoilLimits spoil);

/// The subject, taken for OpenSubdiv: known deviations are expected of it.
Subject in_the_name_of_opensubdiv(Subject subject);

/// The program run with these arguments: its exit code and what it printed.
struct Outcome {
    int code;
    std::string out, err;
};
Outcome loopcheck(const std::vector<std::string>& arguments,
                  const std::vector<Subject>& subjects = built_in_subjects());

/// The built-in subject of that name.
const Subject& subject(const std::string& name);

/// The next double away from zero, n times.
double ulps_off(double x, int n);

/// All notes of a comparison in one text.
std::string notes(const Comparison& comparison);
std::string notes(const LimitComparison& comparison);

}  // namespace loopcheck::compare::test

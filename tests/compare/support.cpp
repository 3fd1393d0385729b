#include "tests/compare/support.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <utility>

#include "compare/cli/cli.h"
#include "core/loop/limit.h"
#include "core/loop/refine.h"

namespace loopcheck::compare::test {

std::string model_path(const std::string& name) {
    return std::string(LOOPCHECK_MODELS_DIR) + "/" + name + ".obj";
}

core::TriangleMesh model_mesh(const std::string& name) {
    auto model = load_model(model_path(name), false);
    if (!model) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), core::to_string(model.error()).c_str());
        std::abort();
    }
    return std::move(model->mesh);
}

Outcome loopcheck(const std::vector<std::string>& arguments, std::vector<Subject> subjects) {
    std::ostringstream out, err;
    const int code = run(arguments, subjects, out, err);
    return {code, out.str(), err.str()};
}

Subject cheat(const std::string& name, Spoil spoil) {
    Subject out = subject("ours");
    out.name = out.family = name;
    out.refine = [spoil = std::move(spoil)](const core::TriangleMesh& mesh,
                                            const core::SchemeOptions& options, int levels) {
        auto made = core::refine<double>(mesh, options, levels);
        spoil(*made);
        return made;
    };
    return out;
}

Subject cheat_rules(const std::string& name, std::function<void(core::SchemeOptions&)> change) {
    Subject out = subject("ours");
    out.name = out.family = name;
    out.refine = [change = std::move(change)](const core::TriangleMesh& mesh, core::SchemeOptions options,
                                              int levels) {
        change(options);
        return core::refine<double>(mesh, options, levels);
    };
    return out;
}

Subject cheat_limits(const std::string& name, SpoilLimits spoil) {
    Subject out = subject("ours");
    out.name = out.family = name;
    out.limit = [spoil = std::move(spoil)](const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           int levels) {
        auto made = core::limits<double>(mesh, options, levels);
        spoil(*made, core::refine<double>(mesh, options, levels).value());
        return made;
    };
    return out;
}

Subject in_the_name_of_opensubdiv(Subject subject) {
    subject.family = "opensubdiv";
    subject.has_weight_option = false;
    return subject;
}

const Subject& subject(const std::string& name) {
    static const auto table = built_in_subjects();
    const Subject* found = find_subject(table, name);
    if (found == nullptr) {
        std::fprintf(stderr, "no subject %s\n", name.c_str());
        std::abort();
    }
    return *found;
}

double ulps_off(double x, int n) {
    for (int i = 0; i < n; ++i)
        x = std::nextafter(
            x, x < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity());
    return x;
}

namespace {

std::string lines(const std::vector<std::string>& notes) {
    std::string out;
    for (const std::string& note : notes) out += note + "\n";
    return out;
}

}  // namespace

std::string notes(const Comparison& comparison) {
    return lines(comparison.notes);
}

std::string notes(const LimitComparison& comparison) {
    return lines(comparison.notes);
}

}  // namespace loopcheck::compare::test

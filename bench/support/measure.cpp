#include "bench/support/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/support/clock.h"
#include "bench/support/meshes.h"
#include "compare/memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace loopcheck::bench {
namespace {

constexpr double kGibibyte = 0x1p30;

struct Contestant {
    const Subject& subject;
    Measured& measured;
    Run run;
    std::vector<double> times;
};

// Makes it and lets it work once; nothing where it cannot or disagrees, and `measured` says why.
std::optional<Contestant> enter(const Case& c, const Subject& subject, Measured& measured) {
    const auto leave_out = [&](std::string why) {
        measured.left_out = std::move(why);
        return std::nullopt;
    };
    const double needed = subject.bytes_per_item * c.items, available = compare::available_memory();
    if (needed > available)
        return leave_out(fmt::format("It needs about {:.1f} GiB, and {:.1f} are left.", needed / kGibibyte,
                                     available / kGibibyte));
    auto run = subject.make(mesh_of(c));
    measured.failed = !run;
    if (!run) return leave_out(core::to_string(run.error()));
    Contestant out{subject, measured, std::move(*run), {}};
    out.times.push_back(seconds(out.run.work));
    std::string why = out.run.disagreement();
    out.run.clear();
    measured.differs = !why.empty();
    if (measured.differs) return leave_out(std::move(why));
    return out;
}

int rounds_for(const Plan& plan, const std::vector<Contestant>& contestants) {
    double round = 0;
    for (const Contestant& contestant : contestants) round += contestant.times.front();
    return round * plan.least_rounds >= plan.seconds
               ? plan.least_rounds
               : static_cast<int>(std::min(plan.seconds / round, static_cast<double>(plan.most_rounds)));
}

void compete(std::vector<Contestant>& contestants, const Subject& first, int rounds) {
    for (Contestant& contestant : contestants) contestant.times.clear();  // those of the first work
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < contestants.size(); ++i) {
            Contestant& contestant = contestants[(i + static_cast<std::size_t>(round)) % contestants.size()];
            contestant.times.push_back(seconds(contestant.run.work));
            contestant.run.clear();
        }
    for (Contestant& contestant : contestants) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < contestant.times.size(); ++i)
            ratios.push_back(contestant.times[i] / contestants.front().times[i]);
        contestant.measured.seconds = median(contestant.times);
        if (&contestants.front().subject == &first) contestant.measured.ratio = median(std::move(ratios));
    }
}

core::Result<Fresh> fresh_medians(const std::vector<std::string>& arguments, int repetitions) {
    std::vector<double> prepare, work, bytes;
    for (int i = 0; i < repetitions; ++i) {
        auto fresh = run_fresh(arguments);
        if (!fresh) return fresh;
        prepare.push_back(fresh->prepare_seconds);
        work.push_back(fresh->work_seconds);
        bytes.push_back(fresh->bytes);
    }
    return Fresh{median(prepare), median(work), median(bytes)};
}

}  // namespace

std::string name_of(const Case& c, const Subject& subject) {
    return fmt::format("{}/{}/{}/{}/{}/{}", c.task, core::name(c.precision), sphere_faces(c.size), c.level,
                       subject.name, subject.threads);
}

double CaseResult::times_writing(const Measured& m) const {
    return m.seconds /
           (write_seconds[static_cast<std::size_t>(m.threads) - 1] * measured.written * measured.items);
}

void keep_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

CaseResult measure(const Case& c, const Plan& plan, const std::vector<std::string>& fresh) {
    CaseResult out{c, 0, {}, {}};
    for (const Subject& subject : c.subjects) out.subjects.push_back({subject.name, subject.threads});
    {
        WriteTest write(plan.written);
        for (int threads = 1; threads <= 2; ++threads)
            out.write_seconds.push_back(write.seconds_per_byte(threads));
    }
    {
        std::vector<Contestant> contestants;
        for (std::size_t i = 0; i < c.subjects.size(); ++i)
            if (auto entered = enter(c, c.subjects[i], out.subjects[i]))
                contestants.push_back(std::move(*entered));
        out.rounds = rounds_for(plan, contestants);
        compete(contestants, c.subjects.front(), out.rounds);
    }
#ifdef __GLIBC__
    malloc_trim(0);  // the other processes need it
#endif
    for (std::size_t i = 0; i < c.subjects.size(); ++i) {
        if (!out.subjects[i].left_out.empty()) continue;
        std::vector<std::string> arguments = fresh;
        arguments.push_back(name_of(c, c.subjects[i]));
        const auto measured = fresh_medians(arguments, plan.fresh);
        if (measured) {
            out.subjects[i].fresh = *measured;
        } else {
            out.subjects[i].failed = true;
            out.subjects[i].left_out = core::to_string(measured.error());
        }
    }
    return out;
}

}  // namespace loopcheck::bench

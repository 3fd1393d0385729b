#include "bench/support/report.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "bench/support/meshes.h"
#include "core/loop/lattice/kernels.h"

namespace loopcheck::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNano = 1e9;

std::string processor() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string cell(double value, int digits = 3) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

// A count or a rounded number in full, as a table of bytes has it.
std::string whole(double value) {
    return std::isfinite(value) ? fmt::format("{:.0f}", value) : "-";
}

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace

Machine this_machine() {
    return {processor(), std::thread::hardware_concurrency(), LOOPCHECK_COMPILER, LOOPCHECK_FLAGS,
            std::string(core::lattice_instructions())};
}

std::string as_text(const Machine& machine) {
    return fmt::format("processor  {}, {} threads\ncompiler   {}\nflags      {}\nlattice    {}\n",
                       machine.processor, machine.threads, machine.compiler, machine.flags,
                       machine.instructions);
}

Json as_json(const Machine& machine) {
    return {{"processor", machine.processor},
            {"threads", machine.threads},
            {"compiler", machine.compiler},
            {"flags", machine.flags},
            {"lattice_instructions", machine.instructions}};
}

std::string as_text(const CaseResult& result, std::string_view item) {
    const Case& c = result.measured;
    const double per_item = kNano / c.items;
    std::string out = fmt::format(
        "\n{}, {}, {} faces, level {}: {:.0f} x {}, rounds: {}; writing {:.0f} bytes takes {} ns with one "
        "thread, {} with two\n"
        "{:<24} {:>7} {:>9} {:>8} {:>8} | fresh {:>9} {:>9} {:>7}\n",
        c.task, core::name(c.precision), sphere_faces(c.size), c.level, c.items, item, result.rounds,
        c.written, cell(kNano * c.written * result.write_seconds[0]),
        cell(kNano * c.written * result.write_seconds[1]), "", "threads", "ns", "/ ours", "/ write",
        "prepare", "ns", "bytes");
    for (const Measured& m : result.subjects) {
        out += fmt::format("{:<24} {:>7}", m.name, m.threads);
        if (!m.left_out.empty()) {
            out += fmt::format(" {}\n", m.left_out);
            continue;
        }
        out += fmt::format(" {:>9} {:>8} {:>8} |", cell(per_item * m.seconds), cell(m.ratio),
                           cell(result.times_writing(m)));
        if (m.fresh)
            out += fmt::format(" {:>15} {:>9} {:>7}", cell(per_item * m.fresh->prepare_seconds),
                               cell(per_item * m.fresh->work_seconds), whole(m.fresh->bytes / c.items));
        out += '\n';
    }
    return out;
}

Json as_json(const CaseResult& result) {
    const Case& c = result.measured;
    const double per_item = kNano / c.items;
    Json out{{"task", c.task},
             {"precision", core::name(c.precision)},
             {"faces", sphere_faces(c.size)},
             {"level", c.level},
             {"items", c.items},
             {"rounds", result.rounds},
             {"written_bytes", c.written},
             {"write_ns", Json::array()},
             {"subjects", Json::array()}};
    for (const double seconds : result.write_seconds) out["write_ns"].push_back(kNano * seconds * c.written);
    for (const Measured& m : result.subjects) {
        Json subject{{"name", m.name}, {"threads", m.threads}};
        if (!m.left_out.empty()) {
            subject["left_out"] = m.left_out;
        } else {
            subject["ns"] = number(per_item * m.seconds);
            subject["over_ours"] = number(m.ratio);
            subject["over_write"] = number(result.times_writing(m));
            if (m.fresh)
                subject["fresh"] = {{"prepare_ns", number(per_item * m.fresh->prepare_seconds)},
                                    {"ns", number(per_item * m.fresh->work_seconds)},
                                    {"bytes", number(m.fresh->bytes / c.items)}};
        }
        out["subjects"].push_back(std::move(subject));
    }
    return out;
}

}  // namespace loopcheck::bench

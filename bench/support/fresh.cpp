#include "bench/support/fresh.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "bench/support/clock.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace loopcheck::bench {
namespace {

// A line of /proc/self/status, in bytes.
double status(std::string_view wanted) {
    std::ifstream in("/proc/self/status");
    std::string key, rest;
    for (; in >> key; std::getline(in, rest))
        if (double kibibytes = 0; key == wanted && in >> kibibytes) return 1024 * kibibytes;
    return std::numeric_limits<double>::quiet_NaN();
}

// Gives back what is free, and makes the peak what there is now.
bool reset_peak() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    std::ofstream out("/proc/self/clear_refs");
    return static_cast<bool>(out << "5" << std::flush);
}

core::Result<Fresh> parse(const std::string& line) {
    std::istringstream in(line);
    std::string prepare, work, bytes;
    if (!(in >> prepare >> work >> bytes))
        return core::fail(core::ErrorCode::SubjectFailed, "A process of its own printed no measurement.");
    return Fresh{std::strtod(prepare.c_str(), nullptr), std::strtod(work.c_str(), nullptr),
                 std::strtod(bytes.c_str(), nullptr)};
}

}  // namespace

core::Result<Fresh> measure_here(const Subject& subject, const core::TriangleMesh& mesh) {
    const double before = reset_peak() ? status("VmRSS:") : std::numeric_limits<double>::quiet_NaN();
    Fresh out;
    core::Result<Run> run;
    out.prepare_seconds = seconds([&] { run = subject.make(mesh); });
    if (!run) return tl::unexpected(run.error());
    out.work_seconds = seconds(run->work);
    out.bytes = status("VmHWM:") - before;
    return out;
}

std::string to_line(const Fresh& fresh) {
    return fmt::format("{} {} {}\n", fresh.prepare_seconds, fresh.work_seconds, fresh.bytes);
}

core::Result<Fresh> run_fresh(const std::vector<std::string>& arguments) {
    static const std::string program = "/proc/self/exe";
    const auto failed = [](std::string_view what) {
        return core::fail(core::ErrorCode::SubjectFailed, fmt::format("A process of its own {}.", what));
    };
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    int ends[2];
    if (pipe(ends) != 0) return failed("could not be started");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    pid_t child = 0;
    const int refused = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    std::string line;
    char buffer[256];
    if (refused == 0)
        for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
            line.append(buffer, static_cast<std::size_t>(n));
    close(ends[0]);
    if (refused != 0) return failed("could not be started");
    int ended = 0;
    if (waitpid(child, &ended, 0) != child || !WIFEXITED(ended) || WEXITSTATUS(ended) != 0)
        return failed("failed");
    return parse(line);
}

}  // namespace loopcheck::bench

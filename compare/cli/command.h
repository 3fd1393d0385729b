// What the commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/loading.h"
#include "compare/subject.h"
#include "core/bspline/points_file.h"

namespace loopcheck::compare {

inline constexpr int kExitUsage = 2;
inline constexpr int kExitFailed = 3;

/// Where a command writes, and whom it can ask.
struct Context {
    std::span<const Subject> subjects;
    std::ostream& out;
    std::ostream& err;
};

/// A command: what runs when it was chosen.
using Command = std::function<int(const Context&)>;

/// The exit code for an error of a refinement: 3 where a subject failed or cannot do it, 2 where what was
/// asked is too large or the coordinates are out of range.
int exit_code_of(const core::Error& error);

/// Adds a command to the program.
Command add_compare(CLI::App& program);
Command add_curve(CLI::App& program);
Command add_grid(CLI::App& program);
Command add_suite(CLI::App& program);
Command add_merge(CLI::App& program);
Command add_refine(CLI::App& program);
Command add_deviations(CLI::App& program);
Command add_explain(CLI::App& program);
Command add_stencils(CLI::App& program);
Command add_subjects(CLI::App& program);
Command add_limit(CLI::App& program);
Command add_atlas(CLI::App& program);

/// The rules as typed: nothing typed means what the model file says, else the default.
struct RuleFlags {
    std::string boundary, creasing, weights = "loop";

    void add_to(CLI::App& command);
    core::SchemeOptions for_model(const core::Model& model) const;
};

/// --levels, --memory and --triangulate.
struct WorkFlags {
    int levels = 5;
    double memory_gib = 0;
    bool triangulate = false;

    void add_to(CLI::App& command);
    /// Without --triangulate.
    void add_levels_to(CLI::App& command);
    /// Without --levels.
    void add_memory_to(CLI::App& command);
    /// In bytes; what is available where nothing was typed.
    double memory_limit() const;
};

/// Nothing where the text is a positive number, else a complaint.
std::string check_positive(const std::string& text);
/// Nothing where the text is an angle from 0 to 180 degrees, else a complaint.
std::string check_degrees(const std::string& text);

/// --crease-angle: what is done to a mesh before it is refined.
struct MeshFlags {
    std::optional<double> crease_angle;  ///< degrees

    void add_to(CLI::App& command);
    /// What was tagged; nothing where no angle was typed.
    std::optional<CreaseTags> apply_to(core::TriangleMesh& mesh) const;
};

/// --html and --html-vertices.
struct HtmlFlags {
    std::string path;
    std::size_t vertices = 0;  ///< most of a level that is shown

    void add_to(CLI::App& command, std::size_t most_vertices);
    bool wanted() const { return !path.empty(); }
    /// False, with a message, where a report is wanted that this build cannot write.
    bool check(const Context& context) const;
};

/// The subject of that name, or a message and nothing.
const Subject* find_or_complain(const Context& context, std::string_view name, const std::string& precision);

/// Loads a model and prints its warnings, or prints why it cannot be loaded.
core::Result<LoadedModel> load_or_complain(const Context& context, const std::string& path, bool triangulate);

/// Prints an error about a file, as "cow.obj: line 3: sentence [code]".
void complain(const Context& context, const std::string& path, const core::Error& error);

/// The error with the line its point was read from, where it names one.
core::Error on_its_line(core::Error error, const core::PointsFile& file);

/// True, with a message, where two reports would go to one file, or one over a model that is read.
bool outputs_clash(const Context& context, std::span<const std::string> outputs,
                   std::span<const std::string> inputs);

/// Writes a report file, or prints why it cannot be written.
bool write_or_complain(const Context& context, const std::string& path, std::string_view bytes);

/// A line on the terminal that is overwritten as work goes on; nothing where standard error is no terminal.
class Progress {
  public:
    explicit Progress(const Context& context);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(const std::string& line);

  private:
    std::ostream& err_;
    bool on_terminal_;
};

}  // namespace loopcheck::compare

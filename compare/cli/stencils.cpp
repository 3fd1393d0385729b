// loopcheck stencils: rows over the control vertices, as a Matrix Market file.
#include "core/loop/stencils.h"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "compare/cli/command.h"
#include "compare/words.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

struct StencilsFlags {
    std::string model, output;
    std::optional<std::string> at;
    RuleFlags rules;
    WorkFlags work;
    std::optional<int> level;
    bool limit = false;
};

// What was asked for: the matrix, what its rows are, and what they must sum to.
struct Stencils {
    core::SparseMatrix matrix;
    std::string rows;
    core::Index sum_to_one = 0;  // so many rows first; the others sum to 0
};

// "face,u,v"
std::optional<core::SurfaceLocation> parse_location(std::string_view text) {
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
        parts[i] = text.substr(0, comma);
        if (i < 2) text.remove_prefix(comma + 1);
    }
    const auto face = core::parse_integer(parts[0]);
    const auto u = core::parse_double(parts[1]), v = core::parse_double(parts[2]);
    if (!face || !u || !v || *face < 0 || *face > std::numeric_limits<core::Index>::max())
        return std::nullopt;
    return core::SurfaceLocation{static_cast<core::Index>(*face), *u, *v};
}

std::string derivatives_in_words(const core::SurfaceStencil<core::HighPrecision>& stencil) {
    switch (stencil.smoothness) {
        case core::Smoothness::Regular:
            return "position, du, dv, duu, duv, dvv";
        case core::Smoothness::TangentPlane:
            return "position, then two tangents that span the tangent plane of this irregular vertex; no "
                   "length "
                   "or curvature";
        case core::Smoothness::NoPlane:
            return "position only: " + core::sentence(stencil.no_normal);
    }
    return {};
}

core::Result<Stencils> at_location(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                   const core::SurfaceLocation& location) {
    using High = core::HighPrecision;
    core::LimitSurface<High> surface(mesh, options);
    const auto stencil = surface.stencil(location.face, High(location.u), High(location.v));
    if (!stencil) return tl::unexpected(stencil.error());
    return Stencils{core::as_matrix(*stencil, mesh.vertex_count()),
                    fmt::format("face {} at ({}, {}): {}", location.face, core::shortest(location.u),
                                core::shortest(location.v), derivatives_in_words(*stencil)),
                    1};
}

core::Result<Stencils> of_level(const StencilsFlags& flags, const core::TriangleMesh& mesh,
                                const core::SchemeOptions& options) {
    const auto of = flags.limit ? core::StencilOf::VertexLimit : core::StencilOf::Vertex;
    auto matrix = core::stencils(mesh, options, flags.level.value_or(0), of,
                                 flags.work.memory_limit() / core::kStencilBytesPerWeight);
    if (!matrix) return tl::unexpected(matrix.error());
    const core::Index count = matrix->row_count();
    return Stencils{std::move(*matrix),
                    fmt::format("{} vertex of level {}", flags.limit ? "the limit of each" : "each",
                                flags.level.value_or(0)),
                    count};
}

int run_stencils(const Context& context, const StencilsFlags& flags) {
    std::optional<core::SurfaceLocation> location;
    if (!flags.at && !flags.level && !flags.limit) {
        context.err << "stencils takes --level, --limit or --at.\n";
        return kExitUsage;
    }
    if (flags.at) {
        location = parse_location(*flags.at);
        if (!location) {
            context.err << fmt::format("--at takes face,u,v, for instance 0,0.25,0.5; not {}.\n",
                                       printable(*flags.at));
            return kExitUsage;
        }
    }
    const std::array outputs{flags.output};
    const std::array inputs{flags.model};
    if (outputs_clash(context, outputs, inputs)) return kExitUsage;
    const auto model = load_or_complain(context, flags.model, flags.work.triangulate);
    if (!model) return kExitUsage;
    const core::SchemeOptions options = flags.rules.for_model(model->model);
    const auto made =
        location ? at_location(model->mesh, options, *location) : of_level(flags, model->mesh, options);
    if (!made) {
        complain(context, flags.model, made.error());
        return kExitUsage;
    }
    const core::SparseMatrix& matrix = made->matrix;
    const double off = std::max(core::row_sum_error(matrix, 0, made->sum_to_one, 1),
                                core::row_sum_error(matrix, made->sum_to_one, matrix.row_count(), 0));
    const std::string text = core::matrix_market(
        matrix, fmt::format("rows: {}\ncolumns: the vertices of {}\nboundary {}, creasing {}, weights {}",
                            made->rows, printable(flags.model), core::name(options.boundary),
                            core::name(options.creasing), core::name(options.weights)));
    if (flags.output.empty())
        context.out << text;
    else if (!write_or_complain(context, flags.output, text))
        return kExitUsage;
    (flags.output.empty() ? context.err : context.out)
        << fmt::format("{} rows, {} columns, {} weights; row sums right to {:.2g} u sum |w|\n",
                       matrix.row_count(), matrix.column_count, matrix.weights.size(), off);
    return 0;
}

}  // namespace

Command add_stencils(CLI::App& program) {
    auto flags = std::make_shared<StencilsFlags>();
    CLI::App* command = program.add_subcommand(
        "stencils",
        "Write refined vertices, limits or a point of the surface as rows over the control vertices");
    command->add_option("model", flags->model, "an OBJ, OFF, PLY or STL file")->required();
    command->add_option("-o,--output", flags->output, "the Matrix Market file to write; else it is printed");
    CLI::Option* level =
        command
            ->add_option("--level", flags->level, "the vertices of this level; with --limit, 0 if not given")
            ->check(CLI::Range(0, 30));
    CLI::Option* limit = command->add_flag("--limit", flags->limit, "their limits instead of themselves");
    command
        ->add_option(
            "--at", flags->at,
            "face,u,v: a point of the limit surface and its derivatives, u towards the face's second "
            "vertex, v towards its third")
        ->excludes(level)
        ->excludes(limit);
    flags->rules.add_to(*command);
    flags->work.add_memory_to(*command);
    return [flags](const Context& context) { return run_stencils(context, *flags); };
}

}  // namespace loopcheck::compare

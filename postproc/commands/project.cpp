// SPDX-License-Identifier: Apache-2.0
// scree post project: fields of the particles on a regular grid.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/project/grid_file.hpp"
#include "postproc/project/projection.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct ProjectOptions {
  std::string run, output, spacing, smoothing, petsc;
  std::vector<std::string> fields, lower, upper;
  TimeOptions time;
  double stabilization = 1e-2, tolerance = 1e-12;
  std::string preconditioner = "jacobi";
  bool lumped = false, json = false, quiet = false;
};

/// Most cells a grid may have: the arrays of more do not fit into usual memories.
constexpr double most_cells = 1e9;

/// The grid: the domain, or the box that was asked for; without a box widened by whole cells
/// where particles lie beyond the domain.
Lattice choose_lattice(const ProjectOptions& options, const Run& run,
                       const ParticleSnapshot& snapshot) {
  Lattice lattice;
  lattice.dimension = run.dimension();
  lattice.spacing = options.spacing.empty()
                        ? run.cell_size()
                        : parse_value("--spacing", options.spacing, Unit::length);
  if (!(lattice.spacing > 0)) throw UserError("--spacing must be above 0");
  auto low =
      options.lower.empty() ? run.lower() : parse_point("--lower", options.lower, run.dimension());
  auto high =
      options.upper.empty() ? run.upper() : parse_point("--upper", options.upper, run.dimension());
  double cells = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(run.dimension()); ++a) {
    if (!(high[a] > low[a])) throw UserError("--upper must lie above --lower along every axis");
    for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
      const double x = snapshot.position[3 * p + a];
      if (options.lower.empty()) {
        low[a] -= lattice.spacing * std::ceil(std::max(0.0, low[a] - x) / lattice.spacing);
      }
      if (options.upper.empty()) high[a] = std::max(high[a], x);
    }
    const double count = (high[a] - low[a]) / lattice.spacing;
    cells *= count + 1;
    if (cells > most_cells) {
      throw UserError(fmt::format("--spacing {}: a grid of more than {:g} cells; take a larger one",
                                  lattice.spacing, most_cells));
    }
    // Rounding of a whole number of cells must not add one.
    lattice.cells[a] = std::max<std::int64_t>(1, std::llround(std::ceil(count - 1e-6)));
  }
  lattice.origin = low;
  return lattice;
}

/// All fields of the frame that are not sums over particles, or those that were asked for.
std::vector<std::string> chosen_words(const ProjectOptions& options,
                                      const std::vector<FieldInfo>& fields) {
  if (!options.fields.empty()) return options.fields;
  std::vector<std::string> words;
  for (const FieldInfo& field : fields) {
    if (field.name != "mass" && field.name != "volume") words.push_back(field.name);
  }
  return words;
}

/// Reads the frame and leaves in it exactly the fields to project: whole ones by name, single
/// numbers such as stress.p as fields of their own.
ParticleSnapshot read_frame(const ProjectOptions& options, const Run& run, std::size_t frame,
                            std::vector<double>& volumes) {
  const std::vector<FieldInfo>& fields = run.fields();
  const std::vector<std::string> words = chosen_words(options, fields);
  WeightedFrame read =
      read_weighted(run, frame, needed_fields(quantities(words, fields, run.dimension())));
  if (read.count() == 0) throw UserError("the frame holds no particles");
  ParticleSnapshot& snapshot = read.particles;
  volumes = std::move(read.volume);
  std::vector<SnapshotField> kept;
  for (const std::string& word : words) {
    if (word.find('.') != std::string::npos || word == "position") {
      for (const ParticleQuantity& quantity : quantities(word, fields, run.dimension())) {
        kept.push_back({quantity.name, quantity.unit, 1, values_of(quantity, snapshot)});
      }
      continue;
    }
    for (const SnapshotField& field : snapshot.fields) {
      if (field.name == word) kept.push_back(field);
    }
  }
  snapshot.fields = std::move(kept);
  return std::move(snapshot);
}

ProjectionOptions projection_options(const ProjectOptions& options) {
  ProjectionOptions result;
  if (!options.smoothing.empty()) {
    result.terms.smoothing_length =
        parse_value("--smoothing-length", options.smoothing, Unit::length);
    if (result.terms.smoothing_length < 0) throw UserError("--smoothing-length must be at least 0");
  }
  result.terms.stabilization = options.stabilization;
  result.lumped = options.lumped;
  result.solver.prefix = "scree_project_";
  result.solver.preconditioner = options.preconditioner;
  result.solver.tolerance = options.tolerance;
  return result;
}

Report make_report(const ProjectOptions& options, const Projection& projection,
                   const ParticleSnapshot& snapshot, const MpiRank& rank) {
  Report report;
  report.command = "project";
  report.run = options.run;
  const Lattice& lattice = projection.lattice;
  report.facts = {{"time", snapshot.time, "s"},
                  {"output", options.output, ""},
                  {"grid",
                   fmt::format("{} x {} x {} nodes, spacing {:g} m", lattice.nodes(0),
                               lattice.nodes(1), lattice.nodes(2), lattice.spacing),
                   ""},
                  {"particles", static_cast<double>(snapshot.id.size()), ""},
                  {"unknowns", static_cast<double>(projection.unknowns), ""},
                  {"processes", static_cast<double>(rank.size), ""},
                  {"solver", projection.solver, ""}};
  report.columns = {{"field", ""},         {"component", ""},         {"reason", ""},
                    {"iterations", ""},    {"residual", ""},          {"particle_integral", ""},
                    {"grid_integral", ""}, {"conservation_error", ""}};
  std::size_t left_out = 0;
  for (const ComponentReport& part : projection.reports) {
    report.rows.push_back({part.field, static_cast<double>(part.component), part.solve.reason,
                           static_cast<double>(part.solve.iterations), part.solve.residual,
                           part.particle_sum, part.grid_sum, part.error});
    if (part.component == 0 && part.left_out > 0) {
      left_out = part.left_out;
      report.remarks.push_back(fmt::format(
          "{} particles have no {} (another material); the projection is that of the others",
          left_out, part.field));
    }
  }
  if (projection.outside > 0) {
    report.remarks.push_back(
        fmt::format("{} particles lie outside of the grid and do not count", projection.outside));
  }
  return report;
}

void print_report(const ProjectOptions& options, const Report& report) {
  if (options.json) {
    fmt::print("{}", to_json(report));
    return;
  }
  if (options.quiet) return;
  fmt::print("{}", to_text(report));
  for (const auto& row : report.rows) {
    fmt::print(
        "{}[{}]: {}, {} iterations, residual {:.1e}; integral {:.10g}, of the particles "
        "{:.10g}, error {:.1e}\n",
        std::get<std::string>(row[0]), std::get<double>(row[1]), std::get<std::string>(row[2]),
        std::get<double>(row[3]), std::get<double>(row[4]), std::get<double>(row[6]),
        std::get<double>(row[5]), std::get<double>(row[7]));
  }
}

int run_project(const ProjectOptions& options, const PostWords& words) {
  const Run run(options.run);
  const std::string kind = extension_of(options.output);
  if (kind != "vti" && kind != "vtu" && kind != "xdmf") {
    throw UserError("-o " + options.output +
                    ": the name must end in .vti (the whole grid), .vtu or .xdmf "
                    "(cells with particles)");
  }
  check_target(options.output, run);
  if (kind == "xdmf") {
    check_target(std::filesystem::path(options.output).replace_extension(".h5").string(), run);
  }
  const ProjectionOptions chosen = projection_options(options);
  const std::size_t frame = chosen_frames(run.frames(), options.time).front();
  std::vector<double> volumes;
  const ParticleSnapshot snapshot = read_frame(options, run, frame, volumes);
  const Lattice lattice = choose_lattice(options, run, snapshot);
  std::vector<std::string> petsc = words.after_dashes;
  std::istringstream more(options.petsc);
  for (std::string word; more >> word;) petsc.push_back(word);
  const MpiRank rank = start_petsc(petsc);
  const Projection projection = project_fields(lattice, snapshot, volumes, chosen);
  const std::vector<std::string> unused = unused_petsc_options();
  if (!unused.empty()) {
    throw UserError("PETSc does not know the option " + unused.front() +
                    " here; options of this solver begin with -scree_project_, e.g. "
                    "-scree_project_pc_type gamg");
  }
  if (rank.rank > 0) return 0;
  write_grid_file(options.output, projection, snapshot.time);
  print_report(options, make_report(options, projection, snapshot, rank));
  return 0;
}

void declare_grid(OptionSet& set, ProjectOptions& options) {
  set.text("--spacing", options.spacing, "H", "Of the grid (default: the cell size)");
  set.texts("--lower", options.lower, "X Y [Z]", "Lower corner of the grid (default: the domain's)",
            2, 3);
  set.texts("--upper", options.upper, "X Y [Z]", "Upper corner, rounded up to whole cells", 2, 3);
}

void declare_solver(OptionSet& set, ProjectOptions& options) {
  set.text("--smoothing-length", options.smoothing, "L", "Helmholtz smoothing (default: none)");
  set.number("--stabilization", options.stabilization, 0, 1e3, "G",
             "Of cells at the edge of the body; 0: none (default: 0.01)");
  set.flag("--lumped", options.lumped,
           "Divide by the volume around each node instead of solving (order 1)");
  set.choice("--preconditioner", options.preconditioner, {"jacobi", "gamg", "hypre", "ml"},
             "Of the solver (default: jacobi)");
  set.number("--tolerance", options.tolerance, 1e-15, 0.1, "R",
             "Of the relative residual (default: 1e-12)");
  set.text("--petsc-options", options.petsc, "TEXT",
           "More options for PETSc, prefix scree_project_; also after --");
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<ProjectOptions>();
  ProjectOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("-o,--output", options.output, "FILE.vti|FILE.vtu|FILE.xdmf",
           "Grid file: .vti the whole grid, .vtu and .xdmf (with FILE.h5) the cells with "
           "particles",
           true);
  set.texts("--fields,--field", options.fields, "F,F,...",
            "Fields, or single numbers such as stress.p (default: all but mass and volume)");
  add_time_options(set, options.time, false);
  declare_grid(set, options);
  declare_solver(set, options);
  set.flag("--json", options.json, "Print what the solver did as JSON");
  set.flag("--quiet", options.quiet, "Print errors only");
  return [shared](const PostWords& words) { return run_project(*shared, words); };
}

}  // namespace

PostCommand post_project() {
  return {"project", "Particle fields on a regular grid: consistent L2 projection", true, &declare};
}

}  // namespace scree

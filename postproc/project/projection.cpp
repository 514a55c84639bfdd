// SPDX-License-Identifier: Apache-2.0
#include "postproc/project/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "solver/base/error.hpp"

namespace scree {
namespace {

/// The system of the particles that have a value in a field, and its solver.
class Projector {
 public:
  Projector(const Lattice& lattice, const ParticleSnapshot& snapshot,
            const std::vector<double>& volumes, const std::vector<char>& chosen,
            const ProjectionOptions& options, const MpiRank& rank)
      : lattice_(lattice), options_(options), rank_(rank) {
    for (std::size_t p = 0; p < chosen.size(); ++p) {
      if (!chosen[p]) continue;
      for (std::size_t a = 0; a < 3; ++a) points_.position.push_back(snapshot.position[3 * p + a]);
      points_.weight.push_back(volumes[p]);
      index_.push_back(p);
    }
    system_ =
        std::make_unique<ProjectionSystem>(lattice, points_, options.terms, rank.rank, rank.size);
    if (system_->nodes().empty()) throw UserError("no particle lies in the grid");
    volumes_ = system_->node_volumes();
    solver_ = std::make_unique<SpdSolver>(system_->matrix(), options.solver);
  }

  const ProjectionSystem& system() const { return *system_; }
  std::string describe() const { return options_.lumped ? "lumped" : solver_->describe(); }

  /// A value of each unknown on the nodes of the lattice; zero elsewhere.
  std::vector<double> on_lattice(const std::vector<double>& unknowns) const {
    std::vector<double> result(static_cast<std::size_t>(lattice_.node_count()), 0.0);
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      result[static_cast<std::size_t>(system_->nodes()[i])] = unknowns[i];
    }
    return result;
  }

  std::vector<double> node_volumes() { return on_lattice(solver_->gather(volumes_)); }

  /// Projects component c of a field; returns its nodal values on process 0.
  std::vector<double> project(const SnapshotField& field, std::size_t c, ComponentReport& report) {
    const auto components = static_cast<std::size_t>(field.components);
    std::vector<double> values(points_.count());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = field.values[index_[i] * components + c];
    }
    std::vector<double> b = system_->right_hand_side(values);
    report.left_out = field.values.size() / components - values.size();
    const std::vector<double> unknowns = known(b, report);
    double size = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!system_->inside(i)) continue;
      report.particle_sum += points_.weight[i] * values[i];
      size += points_.weight[i] * std::abs(values[i]);
    }
    std::vector<double> nodes = on_lattice(unknowns);
    if (rank_.rank == 0) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!system_->inside(i)) continue;
        report.grid_sum +=
            points_.weight[i] * interpolate(lattice_, nodes, &points_.position[3 * i]);
      }
      const double difference = std::abs(report.grid_sum - report.particle_sum);
      report.error = size > 0 ? difference / size : difference;
    }
    return nodes;
  }

 private:
  /// The unknowns of a right-hand side. Components that are zero or were solved before (the other
  /// half of a symmetric tensor) cost nothing.
  std::vector<double> known(std::vector<double>& b, ComponentReport& report) {
    const auto before = solved_.find(b);
    // All processes must agree, for solving is done together.
    if (sum_over_ranks(before == solved_.end() ? 1 : 0) == 0) {
      report.solve = before->second.second;
      return before->second.first;
    }
    std::vector<double> unknowns;
    if (options_.lumped) {
      std::vector<double> part(b.size());
      for (std::size_t i = 0; i < b.size(); ++i) {
        part[i] = volumes_[i] > 0 ? b[i] / volumes_[i] : 0;
      }
      unknowns = solver_->gather(part);
      report.solve.converged = true;
      report.solve.reason = "LUMPED";
      report.solve.sentence = "no system to solve";
    } else {
      unknowns = solver_->solve(b, report.solve);
    }
    if (!report.solve.converged) {
      throw RunFault(fmt::format(
          "the projection of {} (component {}) did not converge: {}; solver {}. Take "
          "--preconditioner jacobi, a larger --tolerance, or a spacing with more particles a cell",
          report.field, report.component, report.solve.sentence, solver_->describe()));
    }
    solved_[std::move(b)] = {unknowns, report.solve};
    return unknowns;
  }

  Lattice lattice_;
  ProjectionOptions options_;
  MpiRank rank_;
  WeightedPoints points_;
  std::vector<std::size_t> index_;  ///< of the points in the snapshot
  std::unique_ptr<ProjectionSystem> system_;
  std::unique_ptr<SpdSolver> solver_;
  std::vector<double> volumes_;
  std::map<std::vector<double>, std::pair<std::vector<double>, SolveReport>> solved_;
};

/// Which particles have finite values of all components.
std::vector<char> with_value(const SnapshotField& field, std::size_t count) {
  std::vector<char> chosen(count, 1);
  const auto components = static_cast<std::size_t>(field.components);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (!std::isfinite(field.values[i])) chosen[i / components] = 0;
  }
  return chosen;
}

}  // namespace

Projection project_fields(const Lattice& lattice, const ParticleSnapshot& snapshot,
                          const std::vector<double>& volumes, const ProjectionOptions& options) {
  const MpiRank rank = start_petsc({});
  const std::size_t count = snapshot.id.size();
  std::map<std::vector<char>, std::unique_ptr<Projector>> projectors;
  const auto projector = [&](const std::vector<char>& chosen) -> Projector& {
    std::unique_ptr<Projector>& found = projectors[chosen];
    if (!found) {
      found = std::make_unique<Projector>(lattice, snapshot, volumes, chosen, options, rank);
    }
    return *found;
  };
  Projector& all = projector(std::vector<char>(count, 1));
  Projection result;
  result.lattice = lattice;
  result.volume = all.node_volumes();
  result.outside = all.system().outside();
  result.unknowns = all.system().matrix().size;
  result.solver = all.describe();
  result.active_cell = all.system().active_cells();
  for (const SnapshotField& field : snapshot.fields) {
    Projector& those = projector(with_value(field, count));
    SnapshotField nodes{field.name, field.unit, field.components, {}};
    const auto components = static_cast<std::size_t>(field.components);
    nodes.values.resize(static_cast<std::size_t>(lattice.node_count()) * components);
    for (std::size_t c = 0; c < components; ++c) {
      ComponentReport report;
      report.field = field.name;
      report.component = static_cast<int>(c);
      const std::vector<double> values = those.project(field, c, report);
      for (std::size_t i = 0; i < values.size(); ++i) nodes.values[i * components + c] = values[i];
      result.reports.push_back(report);
    }
    result.fields.push_back(std::move(nodes));
  }
  return result;
}

}  // namespace scree

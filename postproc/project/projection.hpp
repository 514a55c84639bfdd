// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/project/lattice.hpp"
#include "postproc/project/petsc_solver.hpp"
#include "postproc/project/projection_system.hpp"
#include "solver/io/snapshot.hpp"

namespace scree {

struct ProjectionOptions {
  ProjectionTerms terms;
  bool lumped = false;  ///< divide by the volume around each node instead of solving
  SolverChoice solver;
};

/// What the projection of one component did.
struct ComponentReport {
  std::string field;
  int component = 0;
  SolveReport solve;         ///< of lumped projections: converged, no iterations
  double particle_sum = 0;   ///< sum of V_p u_p
  double grid_sum = 0;       ///< sum of V_p u(x_p), the same integral of the projected field
  double error = 0;          ///< their difference over sum of V_p |u_p|
  std::size_t left_out = 0;  ///< particles without a value of this field
};

/// Fields on the nodes of a lattice; zero at nodes without a particle in any cell around them.
struct Projection {
  Lattice lattice;
  std::vector<double> volume;     ///< of the particles, shared out to the nodes [m^3]
  std::vector<char> active_cell;  ///< whether a cell holds particles
  std::vector<SnapshotField> fields;
  std::vector<ComponentReport> reports;
  std::string solver;       ///< its name, for people
  std::size_t outside = 0;  ///< particles beyond the lattice
  std::int64_t unknowns = 0;
};

/// Projects all fields of a snapshot. All processes of MPI call it together; the result is whole on
/// process 0. Throws RunFault where the solver does not converge.
Projection project_fields(const Lattice& lattice, const ParticleSnapshot& snapshot,
                          const std::vector<double>& volumes, const ProjectionOptions& options);

}  // namespace scree

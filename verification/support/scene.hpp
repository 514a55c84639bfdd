// SPDX-License-Identifier: Apache-2.0
//
// Small simulations for the tests, particle by particle, and their twins in the reference method.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "materials/drucker_prager.hpp"
#include "materials/fixed_corotated.hpp"
#include "materials/j_fluid.hpp"
#include "materials/neo_hookean.hpp"
#include "solver/simulation/simulation.hpp"
#include "verification/reference/solver.hpp"

namespace scree::testing {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

/// One way to compute a step.
struct Method {
  KernelType kernel = KernelType::compact;
  TransferType transfer = TransferType::mls;
  PathType path = PathType::automatic;
  Precision precision = Precision::double_;
  bool affine() const { return transfer == TransferType::mls || transfer == TransferType::apic; }
};
std::string to_string(const Method& method);
inline std::ostream& operator<<(std::ostream& out, const Method& method) {
  return out << to_string(method);
}

/// Every kernel with every transfer that it offers, mls both fused and split, in double.
std::vector<Method> all_methods();

/// An empty domain at `lower` with open faces and no gravity.
SimulationSetup make_setup(int dimension, const Method& method, double cell_size,
                           std::array<int, 3> cells, const Vector& lower = Vector::Zero());

/// Centres of a lattice of `spacing` that fills the box, without those that `inside` rejects; z = 0
/// in 2D.
std::vector<Vector> lattice(const Vector& lower, const Vector& upper, double spacing, int dimension,
                            const std::function<bool(const Vector&)>& inside = {});

/// Parameters of a fixed-corotated solid.
struct Jelly {
  double youngs_modulus = 1e5;
  double poissons_ratio = 0.3;
  double density = 1000;
  double wave_speed() const;
};

/// A body of jelly of particles of volume spacing^dimension at rest; appended to the setup.
BodySetup& add_jelly(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                     const Jelly& jelly, const std::string& name = "jelly");

/// The same of a neo-Hookean solid, of sand (cohesion and dilation angle 0 unless given) and of a
/// fluid.
BodySetup& add_rubber(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                      const NeoHookean::Input& input, double density);
BodySetup& add_sand(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                    const DruckerPrager::Input& input, double density);
BodySetup& add_fluid(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                     const JFluid::Input& input, double density);

/// Gives all particles of a body the velocity v0 + gradient (x - center) and that gradient.
void set_velocity(BodySetup& body, const Vector& v0, const Matrix& gradient = Matrix::Zero(),
                  const Vector& center = Vector::Zero());

/// n steps of length dt, one history row a step where `rows`, all recorded at the end.
void set_steps(SimulationSetup& setup, int n, double dt, bool rows = false);

/// All steps to the end of the schedule.
void run(Simulation& simulation, const Schedule& schedule);

/// The same, with every due history row, the first at t = 0.
std::vector<HistoryRow> run_with_history(Simulation& simulation, const Schedule& schedule);

/// Position, velocity and deformation gradient of all particles by id; valid when recorded.
struct State {
  std::vector<Vector> x, v;
  std::vector<Matrix> F;
};
State state_of(const Simulation& simulation);

/// One named field of a snapshot; throws where there is none.
const SnapshotField& field(const ParticleSnapshot& snapshot, const std::string& name);

/// Largest distance between entries; NaN if one is, infinity for lists of different lengths.
double distance(const std::vector<Vector>& a, const std::vector<Vector>& b);
double distance(const std::vector<Matrix>& a, const std::vector<Matrix>& b);

/// The reference method's twin of a setup with sticky, slip, symmetry and open
/// faces and constant gravity. Positions are from the domain's lower corner.
struct Twin {
  std::vector<std::unique_ptr<reference::Material>> materials;
  std::unique_ptr<reference::Solver> solver;
  Vector lower;
  State state() const;
};
Twin reference_twin(const SimulationSetup& setup);

}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
//
// Drops of spray: fluid particles that have their nodes to themselves.
#include "solver/simulation/lone_particle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

/// tr D^-1 and the mean over the lattices of sum |grad w|^2/w at a position in cells.
template <class Kernel, int D>
struct Traces {
  double moment = 0, slopes = 0;

  explicit Traces(const double (&u)[D]) {
    const auto p = Kernel::template at<double, D>(u);
    double one[D][D] = {}, inverse[D][D];
    for (int a = 0; a < D; ++a) one[a][a] = 1;
    Kernel::template times_inverse_moment<double, D>(p, one, inverse);
    const auto s = Kernel::template slopes<double, D>(p);
    for (int a = 0; a < D; ++a) {
      moment += inverse[a][a];
      for (int k = 0; k < Kernel::lattices; ++k)
        for (int i = 0; i < Kernel::support; ++i)
          slopes +=
              s.slope[k][a][i] * s.slope[k][a][i] / (Kernel::lattices * p.stencil.weight[k][a][i]);
    }
  }
};

/// The smallest bound over a lattice of positions that holds the quarters and halves of a cell.
template <class Kernel, int D>
double smallest_courant(TransferType transfer) {
  const int n = 16;
  const bool remembers = transfer == TransferType::mls || transfer == TransferType::apic;
  double stiffest = 0;
  for (int i = 0; i < (D == 3 ? n * n * n : n * n); ++i) {
    // Off the nodes by 1e-9, where a weight is 0 and the quotient 0/0.
    double u[D];
    for (int a = 0, rest = i; a < D; ++a, rest /= n) u[a] = 1 + double(rest % n) / n + 1e-9;
    const Traces<Kernel, D> t(u);
    const double kick = transfer == TransferType::mls ? t.moment : t.slopes;
    stiffest = std::max(stiffest, kick - (remembers ? t.moment / 2 : 0));
  }
  return std::sqrt(2 / stiffest);
}

TEST(LoneParticle, bound_is_that_of_the_kernels_own_weights) {
  for (TransferType transfer :
       {TransferType::mls, TransferType::apic, TransferType::flip, TransferType::pic}) {
    const auto bound = [&](KernelType kernel, int dimension) {
      return lone_particle_courant(kernel, transfer, dimension);
    };
    // 1e-6: the positions are off the extremes by 1e-9.
    EXPECT_NEAR(bound(KernelType::compact, 2), (smallest_courant<Compact, 2>(transfer)), 1e-6);
    EXPECT_NEAR(bound(KernelType::compact, 3), (smallest_courant<Compact, 3>(transfer)), 1e-6);
    EXPECT_NEAR(bound(KernelType::quadratic, 2), (smallest_courant<Quadratic, 2>(transfer)), 1e-6);
    EXPECT_NEAR(bound(KernelType::quadratic, 3), (smallest_courant<Quadratic, 3>(transfer)), 1e-6);
  }
}

/// Drops far apart, each at another place in its cell, that swell at the rate `rate` [1/s].
SimulationSetup drops(int dimension, const Method& method, double wave_speed, double rate) {
  const int across = 3, apart = 6;
  SimulationSetup setup = make_setup(dimension, method, 1, {24, 24, 24});
  std::vector<Vector> points;
  for (int i = 0; i < (dimension == 3 ? across * across * across : across * across); ++i) {
    const Vector cell(i % across, i / across % across, i / across / across);
    Vector x = 5 * Vector::Ones() + apart * cell + Vector(0.31 * i, 0.17 * i, 0.23 * i) * 0.25;
    if (dimension == 2) x[2] = 0;
    points.push_back(x);
  }
  const double density = 1000, gamma = 7;
  const JFluid::Input water{density * wave_speed * wave_speed / gamma, gamma, 0, 1};
  BodySetup& body = add_fluid(setup, points, 0.5, water, density);
  Matrix gradient = Matrix::Zero();
  for (int a = 0; a < dimension; ++a) gradient(a, a) = rate / dimension;
  const Vector drift = 0.03 * wave_speed * Vector(1, 0.7, dimension == 3 ? -0.4 : 0);
  set_velocity(body, drift, gradient);
  for (std::size_t p = 0; p < points.size(); ++p)  // each swells about its own centre
    for (int a = 0; a < 3; ++a) body.velocity[3 * p + std::size_t(a)] = drift[a];
  return setup;
}

class LoneParticles : public ::testing::TestWithParam<Method> {};

/// With the largest cfl that a deck may have. The oscillator of lone_particle_courant() swings by
/// b/sqrt(w (1 - w/4)), b the dilation of the first step, w = k a < 3.17: at most 1.3 b for those
/// that start in any place; 4 b leave room for the change of w on the way. Unstable ones grow by
/// more than a tenth a step.
TEST_P(LoneParticles, spray_stays_in_one_piece_at_any_cfl) {
  if (GetParam().kernel == KernelType::linear) return;  // has no bound
  for (int dimension : {2, 3}) {
    const double c = 20, rate = 0.02;
    SimulationSetup setup = drops(dimension, GetParam(), c, rate);
    setup.cfl = 0.5;
    setup.schedule = Schedule(4, 0, 0, 0);  // 160 to 340 steps, 2.4 cells of drift
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    const auto snapshot = simulation->particles({"volume_strain"});
    double largest = 0;
    for (double e : field(snapshot, "volume_strain").values)
      largest = std::max(largest, std::abs(e));
    EXPECT_LE(largest, 4 * rate * 0.5 / c) << "dimension " << dimension;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, LoneParticles, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing

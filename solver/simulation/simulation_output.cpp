// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/simulation/visit_block.hpp"

namespace scree {
namespace {

/// Sums over the particles of one block.
struct BlockSums {
  double momentum[3] = {0, 0, 0};
  double angular[3] = {0, 0, 0};
  double moment[3] = {0, 0, 0};  ///< sum of m x
  double kinetic = 0;
  double elastic = 0;
  double max_speed = 0;
  double fluid = 0;

  void add(const BlockSums& other) {
    for (int a = 0; a < 3; ++a) {
      momentum[a] += other.momentum[a];
      angular[a] += other.angular[a];
      moment[a] += other.moment[a];
    }
    kinetic += other.kinetic;
    elastic += other.elastic;
    fluid += other.fluid;
    max_speed = std::max(max_speed, other.max_speed);
  }
};

/// Adds one particle; B: affine matrix [m^2/s], 3x3.
void add_particle(BlockSums& sums, const ParticleView& p, double mass, double volume) {
  const auto& x = p.position;
  const auto& v = p.velocity;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    sums.momentum[a] += mass * v[a];
    sums.moment[a] += mass * x[a];
    // x cross m v, and the spin that the affine matrix carries: m eps_abc B_cb.
    sums.angular[a] += mass * (x[b] * v[c] - x[c] * v[b] + p.affine[c][b] - p.affine[b][c]);
  }
  const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  sums.kinetic += 0.5 * mass * square;
  sums.elastic += volume * p.energy_density;
  sums.fluid += p.fluid_mass;
  sums.max_speed = std::max(sums.max_speed, std::sqrt(square));
}

}  // namespace

template <int D, class T>
std::int64_t SimulationImpl<D, T>::particle_count() const {
  std::int64_t count = -pending_dead_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) count += backend_->count(i);
  return count;
}

template <int D, class T>
void SimulationImpl<D, T>::require_record(const char* what) const {
  if (recorded_ && layout_.velocity >= 0) return;
  throw std::logic_error(std::string(what) +
                         " asked for at a time that is no event of the schedule");
}

template <int D, class T>
HistoryRow SimulationImpl<D, T>::history() const {
  require_record("history");
  backend_->give_particles();
  BlockSums total;
  HistoryRow row;
  for (const State& state : bodies_) {
    const BodyInfo& info = state.body->info();
    std::vector<BlockSums> sums(state.body->store().blocks().size());
    executor_.pool().for_each(std::int64_t(sums.size()), [&](std::int64_t b, int) {
      visit_block(state, std::size_t(b), [&](const ParticleView& view) {
        add_particle(sums[std::size_t(b)], view, info.particle_mass(), info.particle_volume);
      });
    });
    for (const BlockSums& s : sums) total.add(s);
    row.mass += double(state.body->store().count() - state.dead) * info.particle_mass();
  }
  row.step = step_;
  row.time = clock_.time;
  row.dt = step_ == 0 ? clock_.dt : clock_.last_dt;
  row.particle_count = particle_count();
  for (int a = 0; a < 3; ++a) {
    row.momentum[a] = total.momentum[a];
    row.angular_momentum[a] = total.angular[a];
    row.center[a] = row.mass > 0 ? total.moment[a] / row.mass : 0;
  }
  row.kinetic_energy = total.kinetic;
  row.elastic_energy = total.elastic;
  row.max_speed = total.max_speed;
  if (flow_) row.fluid = flow_->balance(total.fluid);
  for (std::size_t c = 0; c < colliders_.size(); ++c) {
    const Reaction none;
    const Reaction& r = c < backend_->reactions().size() ? backend_->reactions()[c] : none;
    row.collider_force_torque.push_back(
        {r.force[0], r.force[1], r.force[2], r.torque[0], r.torque[1], r.torque[2]});
  }
  row.collider_work = collider_work_;
  if (external_) row.external_work = external_work(external_power());
  return row;
}

template <int D, class T>
MemoryReport SimulationImpl<D, T>::memory() const {
  MemoryReport report;
  for (const State& state : bodies_) report.particles += state.body->store().bytes();
  report.grid = backend_->grid_bytes();
  report.other = backend_->other_bytes() + std::int64_t(reference_.capacity() * sizeof(double));
  if (flow_) report.other += flow_->bytes();
  return report;
}

template <int D, class T>
PhaseTimes SimulationImpl<D, T>::phases() const {
  const auto at = [&](Phase phase) { return seconds_[std::size_t(phase)]; };
  PhaseTimes times{{"binning", at(Phase::binning)},
                   {"grid", at(Phase::grid)},
                   {"particles", at(Phase::particles)}};
  if (!fused_) times.emplace_back("stress", at(Phase::stress));
  if (external_) times.emplace_back("external_forces", at(Phase::external));
  if (!flow_) return times;
  double rest = at(Phase::pressure);
  for (const auto& [name, seconds] : flow_->times()) {
    times.emplace_back(name, seconds);
    rest -= seconds;
  }
  times.emplace_back("pore_transfer", rest);
  return times;
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree

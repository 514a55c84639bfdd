// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solver/base/error.hpp"
#include "solver/simulation/simulation.hpp"
#include "solver/simulation/step_clock.hpp"

namespace scree {

/// A stand-in with the manners of a simulation and no physics: every particle follows the logistic
/// map, which doubles any difference in its bits each step, so that a continued run that is not
/// exactly the same soon is visibly another.
class FakeSimulation : public Simulation {
 public:
  FakeSimulation(Schedule schedule, double stable, std::size_t count)
      : schedule_(schedule), stable_(stable), x_(count) {
    for (std::size_t p = 0; p < count; ++p) x_[p] = 0.1 + 0.8 * double(p) / double(count);
    planned_ = plan_step(schedule_, 0, stable_);
  }

  std::function<void(std::int64_t step)> before_step = [](std::int64_t) {};

  void step() override {
    before_step(steps_);
    for (double& x : x_) x = 3.99 * x * (1 - x) * (1 - 1e-9 * planned_.dt);
    time_ = planned_.end;
    last_dt_ = planned_.dt;
    ++steps_;
    planned_ = plan_step(schedule_, time_, stable_);
  }
  double time() const override { return time_; }
  double dt() const override { return planned_.dt; }
  double next_time() const override { return planned_.end; }
  std::int64_t step_count() const override { return steps_; }
  std::int64_t particle_count() const override { return static_cast<std::int64_t>(x_.size()); }
  std::int64_t removed_count() const override { return 0; }
  bool fused() const override { return false; }

  HistoryRow history() const override {
    HistoryRow row;
    row.step = steps_;
    row.time = time_;
    row.dt = last_dt_;
    row.particle_count = particle_count();
    for (double x : x_) row.kinetic_energy += x;
    return row;
  }
  using Simulation::particles;
  ParticleSnapshot particles(const std::vector<std::string>& fields,
                             const ParticleFilter& filter) const override {
    ParticleSnapshot snapshot;
    snapshot.time = time_;
    snapshot.step = steps_;
    std::vector<double> kept;
    for (std::size_t p = 0; p < x_.size(); ++p) {
      const double position[3] = {x_[p], 1.0, 0.0};
      if (filter && !filter(static_cast<std::int64_t>(p), position)) continue;
      kept.push_back(x_[p]);
      snapshot.position.insert(snapshot.position.end(), position, position + 3);
      snapshot.id.push_back(static_cast<std::int64_t>(p));
      snapshot.material.push_back(0);
      snapshot.body.push_back(0);
    }
    for (const std::string& field : fields) snapshot.fields.push_back({field, "", 1, kept});
    return snapshot;
  }
  std::vector<GridSnapshot> grid() const override {
    GridSnapshot lattice;
    lattice.time = time_;
    lattice.lattice = "nodes";
    lattice.spacing = 1;
    lattice.nodes[0] = particle_count();
    lattice.nodes[1] = 1;
    lattice.fields = {{"mass", "kg", 1, x_}};
    return {lattice};
  }

  void save(StateWriter& writer) const override {
    writer.put("simulation/x", x_);
    writer.put("simulation/clock", std::vector<double>{time_, last_dt_, planned_.dt, planned_.end});
    writer.put_value("simulation/steps", steps_);
  }
  void load(const StateReader& reader) override {
    x_ = reader.get<double>("simulation/x");
    const std::vector<double> clock = reader.get<double>("simulation/clock");
    time_ = clock.at(0);
    last_dt_ = clock.at(1);
    planned_ = {clock.at(2), clock.at(3)};
    steps_ = reader.get_value<std::int64_t>("simulation/steps");
  }

  std::int64_t block_count() const override { return 1; }
  MemoryReport memory() const override { return {}; }
  PhaseTimes phases() const override { return {{"transfer", 0.5}}; }

 private:
  Schedule schedule_;
  double stable_;
  std::vector<double> x_;
  double time_ = 0, last_dt_ = 0;
  PlannedStep planned_{};
  std::int64_t steps_ = 0;
};

}  // namespace scree

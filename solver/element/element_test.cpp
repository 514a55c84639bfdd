// SPDX-License-Identifier: Apache-2.0
#include "solver/element/element_test.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "materials/registry.hpp"
#include "materials/undrained_point.hpp"
#include "solver/base/error.hpp"
#include "solver/base/stress_invariants.hpp"
#include "solver/element/held_step.hpp"

namespace scree {
namespace {

/// Steps of the stages before the path: laws whose return map is of first order in the step lose
/// less than the path itself does.
constexpr int stage_steps = 200;
/// Duration of a stage over that of the path: rates of strain leave no stress in the result.
constexpr double stage_slowness = 1e6;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

const char* held_name(HeldStress held) {
  if (held == HeldStress::mean) return "pressure";
  return held == HeldStress::axis_2 ? "normal stress on axis 2" : "lateral stress";
}

class Drive {
 public:
  explicit Drive(const ElementDeck& deck)
      : material_(deck.materials.front()),
        path_(deck.driven),
        point_(make_material_point(material_.model, material_.input, material_.density, 3)) {}

  ElementResult run() {
    if (path_.confining_pressure) {
      stage(*confining_motion(), HeldStress::mean, *path_.confining_pressure, "confinement");
    }
    if (path_.normal_stress) {
      stage(*normal_motion(), HeldStress::axis_2, *path_.normal_stress, "loading of axis 2");
    }
    add_water();
    motion_ = path_motion(path_, water_);
    const Sym3<double> confined = cauchy_stress(*point_);
    cell_pressure_ =
        path_.confining_pressure.value_or(held_component(confined, HeldStress::lateral));
    result_.fields = find_material_model(material_.model)->fields;
    result_.void_ratio_known = point_->void_ratio() || path_.initial_void_ratio > 0;
    record(0);
    follow();
    finish();
    return std::move(result_);
  }

 private:
  /// The stages before the path are drained: the excess pressure starts at zero.
  void add_water() {
    water_ = material_.undrained_bulk_modulus.has_value();
    if (!water_) return;
    point_ =
        add_pore_water(std::move(point_), *material_.undrained_bulk_modulus, material_.density);
  }

  /// Brings a stress to `target` in equal increments.
  void stage(const Motion& motion, HeldStress held, double target, const char* name) {
    const double start = held_component(cauchy_stress(*point_), held);
    const double dt = stage_slowness * path_.duration / stage_steps;
    HeldStep step(*point_, motion, held, material_.density, dt);
    PathState state;
    double last = 0;
    for (int i = 1; i <= stage_steps && start != target; ++i) {
      const double wanted = i == stage_steps ? target : start + (target - start) * i / stage_steps;
      const HeldOutcome outcome = step.take(state, 0, wanted, state.free + last);
      if (!outcome.converged) {
        throw RunFault("step " + std::to_string(i) + " of " + std::to_string(stage_steps) + " of " +
                       name + ": " + fault_of(outcome, held, wanted));
      }
      last = outcome.free - state.free;
      state.free = outcome.free;
    }
  }

  static std::string fault_of(const HeldOutcome& outcome, HeldStress held, double wanted) {
    return std::string("a ") + held_name(held) + " of " + number(wanted) +
           " Pa cannot be held, the nearest is " + number(outcome.stress) + " Pa: " + outcome.cause;
  }

  /// The controlled strains at which the path turns.
  std::vector<double> turns() const {
    if (path_.type == LabTest::gradient) return {1.0};
    std::vector<double> targets;
    for (int i = 0; i < path_.cycles; ++i) {
      targets.push_back(path_.strain);
      if (path_.unload) targets.push_back(*path_.unload);
    }
    return targets;
  }

  void follow() {
    const auto targets = turns();
    total_ = static_cast<int>(targets.size()) * path_.steps;
    int step = 0;
    double start = 0;
    for (const double target : targets) {
      for (int i = 1; i <= path_.steps; ++i) {
        const double share = double(i) / path_.steps;
        advance(++step, i == path_.steps ? target : start + (target - start) * share);
        record(step);
      }
      start = target;
    }
  }

  void advance(int step, double control) {
    const double dt = path_.duration / path_.steps;
    PathState next{control, state_.free};
    if (const auto held = held_stress()) {
      HeldStep solver(*point_, *motion_, *held, material_.density, dt);
      const double wanted =
          *held == HeldStress::axis_2 ? path_.normal_stress.value() : cell_pressure_;
      const HeldOutcome outcome = solver.take(state_, control, wanted, state_.free + last_);
      if (!outcome.converged) fail(step, next, fault_of(outcome, *held, wanted));
      next.free = outcome.free;
    } else {
      point_->advance(motion_->increment(state_, next), dt);
      if (!point_->admissible()) fail(step, next, inadmissible_cause(*point_, "this deformation"));
    }
    last_ = next.free - state_.free;
    state_ = next;
    const Sym3<double> s = point_->stress();
    if (!std::isfinite(s.xx + s.yy + s.zz + s.xy + s.xz + s.yz)) {
      fail(step, next, "the stress is no finite number");
    }
  }

  std::optional<HeldStress> held_stress() const {
    if (path_.type == LabTest::triaxial_drained) return HeldStress::lateral;
    if (path_.type == LabTest::triaxial_undrained && water_) return HeldStress::lateral;
    if (path_.type == LabTest::simple_shear && path_.normal_stress) return HeldStress::axis_2;
    return std::nullopt;
  }

  [[noreturn]] void fail(int step, const PathState& at, const std::string& cause) const {
    throw RunFault("step " + std::to_string(step) + " of " + std::to_string(total_) + " of " +
                   lab_test_name(path_.type) + " (strain " + number(at.control) + "): " + cause +
                   "; more path.steps or a smaller path.strain may help");
  }

  void record(int step) {
    ElementRow row;
    row.step = step;
    row.strain = motion_->strain(state_);
    row.cauchy = cauchy_stress(*point_);
    row.entries = point_->entries();
    row.yield_value = point_->yield_value();
    row.void_ratio =
        point_->void_ratio().value_or((1 + path_.initial_void_ratio) * point_->volume_ratio() - 1);
    if (water_) {
      row.pore_pressure = row.entries.back();
      row.entries.pop_back();
      for (double* normal : {&row.cauchy.xx, &row.cauchy.yy, &row.cauchy.zz}) {
        *normal += *row.pore_pressure;
      }
    } else if (path_.type == LabTest::triaxial_undrained) {
      row.pore_pressure = cell_pressure_ - held_component(row.cauchy, HeldStress::lateral);
    }
    result_.rows.push_back(std::move(row));
  }

  void finish() {
    result_.point = make_material_point(material_.model, material_.input, material_.density, 3);
    result_.point->set_entries(result_.rows.back().entries);
  }

  const MaterialSpec& material_;
  const PathSpec& path_;
  std::unique_ptr<MaterialPoint> point_;
  std::unique_ptr<Motion> motion_;
  bool water_ = false;
  double cell_pressure_ = 0;  ///< on axes 2 and 3 in a triaxial test [Pa]
  PathState state_;
  double last_ = 0;  ///< change of the free stretch in the step before: the next one's guess
  int total_ = 0;
  ElementResult result_;
};

}  // namespace

double ElementRow::pressure() const { return mean_pressure(cauchy); }
double ElementRow::deviatoric() const { return deviatoric_stress(cauchy); }

ElementResult drive_element(const ElementDeck& deck) { return Drive(deck).run(); }

}  // namespace scree

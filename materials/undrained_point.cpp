// SPDX-License-Identifier: Apache-2.0
#include "materials/undrained_point.hpp"

#include <stdexcept>
#include <utility>

#include "materials/pore_water.hpp"

namespace scree {
namespace {

class UndrainedPoint final : public MaterialPoint {
 public:
  UndrainedPoint(std::unique_ptr<MaterialPoint> skeleton, double bulk_modulus, double density)
      : skeleton_(std::move(skeleton)), bulk_modulus_(bulk_modulus), density_(density) {}

  Sym3<double> advance(const Mat3<double>& increment, double dt) override {
    const Sym3<double> effective = skeleton_->advance(increment, dt);
    pressure_ = pore_water::advance(pressure_, bulk_modulus_, increment);
    return pore_water::total(effective, skeleton_->volume_ratio(), pressure_);
  }
  Sym3<double> stress() const override {
    return pore_water::total(skeleton_->stress(), skeleton_->volume_ratio(), pressure_);
  }
  double volume_ratio() const override { return skeleton_->volume_ratio(); }
  double energy_density() const override {
    return skeleton_->energy_density() +
           pore_water::energy_density(volume_ratio(), pressure_, bulk_modulus_);
  }
  double wave_speed() const override {
    return pore_water::wave_speed(skeleton_->wave_speed(), volume_ratio(),
                                  bulk_modulus_ / density_);
  }
  bool admissible() const override { return skeleton_->admissible(); }
  std::optional<double> yield_value() const override { return skeleton_->yield_value(); }
  std::optional<double> void_ratio() const override { return skeleton_->void_ratio(); }

  std::vector<double> entries() const override {
    std::vector<double> values = skeleton_->entries();
    values.push_back(pressure_);
    return values;
  }
  void set_entries(std::span<const double> values) override {
    if (values.empty()) throw std::invalid_argument("wrong number of state entries");
    skeleton_->set_entries(values.first(values.size() - 1));
    pressure_ = values.back();
  }

 private:
  std::unique_ptr<MaterialPoint> skeleton_;
  double bulk_modulus_, density_;
  double pressure_ = 0;
};

}  // namespace

std::unique_ptr<MaterialPoint> add_pore_water(std::unique_ptr<MaterialPoint> skeleton,
                                              double bulk_modulus, double density) {
  return std::make_unique<UndrainedPoint>(std::move(skeleton), bulk_modulus, density);
}

}  // namespace scree

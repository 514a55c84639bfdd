// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "materials/material.hpp"
#include "materials/material_point.hpp"

namespace scree {

/// The point of one law M.
template <Material M>
class MaterialPointOf final : public MaterialPoint {
 public:
  using Params = typename M::template Params<double>;
  using State = typename M::template State<double>;

  explicit MaterialPointOf(const Params& params)
      : params_(params), state_(M::template initial<double>(params)) {}

  Sym3<double> advance(const Mat3<double>& increment, double dt) override {
    return M::kirchhoff(params_, state_, increment, dt);
  }
  Sym3<double> stress() const override {
    State copy = state_;
    return M::kirchhoff(params_, copy, zero3<double>(), 0.0);
  }
  double volume_ratio() const override { return M::volume_ratio(params_, state_); }
  double energy_density() const override { return M::energy_density(params_, state_); }
  double wave_speed() const override { return M::wave_speed(params_, state_); }
  bool admissible() const override { return M::admissible(params_, state_); }

  std::optional<double> yield_value() const override {
    if constexpr (requires { M::yield_value(params_, state_); }) {
      return M::yield_value(params_, state_);
    } else {
      return std::nullopt;
    }
  }
  std::optional<double> void_ratio() const override {
    if constexpr (requires { M::void_ratio(params_, state_); }) {
      return M::void_ratio(params_, state_);
    } else {
      return std::nullopt;
    }
  }

  std::vector<double> entries() const override {
    std::vector<double> values(count);
    __builtin_memcpy(values.data(), &state_, sizeof state_);
    return values;
  }
  void set_entries(std::span<const double> values) override {
    if (values.size() != count) throw std::invalid_argument("wrong number of state entries");
    __builtin_memcpy(static_cast<void*>(&state_), values.data(), sizeof state_);
  }

 private:
  static constexpr std::size_t count = sizeof(State) / sizeof(double);

  Params params_;
  State state_;
};

/// Instantiated once a law, in a unit of its own (cmake/material_point.cpp.in).
template <class M>
std::unique_ptr<MaterialPoint> make_point_of(const std::any& input, double density, int dimension) {
  return std::make_unique<MaterialPointOf<M>>(M::template params<double>(
      std::any_cast<const typename M::Input&>(input), density, dimension));
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
/// \file
/// The laws of materials/list.def without their C++ types: each law is compiled once, in a unit of
/// its own that CMake writes, and the properties that every law must have are plain functions.
#pragma once

#include <any>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/material.hpp"

namespace scree::testing {

inline constexpr double density = 1700;
inline constexpr double degree = 3.14159265358979323846 / 180;

/// A state as numbers in the order of the law's fields(); the rest is zero.
template <class T>
using Entries = std::array<T, 32>;

/// The functions of a law with its parameters, in precision T.
template <class T>
class Point {
 public:
  virtual ~Point() = default;
  virtual Entries<T> initial() const = 0;
  virtual Sym3<T> kirchhoff(Entries<T>& state, const Mat3<T>& L, T dt) const = 0;
  virtual T wave_speed(const Entries<T>& state) const = 0;
  virtual T energy_density(const Entries<T>& state) const = 0;
  virtual T volume_ratio(const Entries<T>& state) const = 0;
  virtual bool admissible(const Entries<T>& state) const = 0;
  /// Nothing for a law without a yield surface.
  virtual std::optional<T> yield_value(const Entries<T>& state) const = 0;
};

/// One lane of a run of two steps, the second with dt = 1 % of a second.
template <class T>
struct LaneRun {
  Mat3<T> first, second;  ///< increments
  Entries<T> state;       ///< at the end, as all below
  Sym3<T> stress;
  T wave_speed, energy_density, volume_ratio;
  bool admissible;
};

/// A law in SIMD lanes of T.
template <class T>
class LaneLaw {
 public:
  virtual ~LaneLaw() = default;
  /// Runs `width` lanes (1: a scalar; 4, 8, 16: packs) from the initial state; `runs` holds as
  /// many.
  virtual void run(int width, LaneRun<T>* runs) const = 0;
};

/// A law with one set of parameters.
struct Law {
  std::string name;  ///< for messages
  std::vector<StateField> fields;
  /// False for a law that says `static constexpr bool hyperelastic = false;`: its elastic stress is
  /// no derivative of its energy.
  bool stress_from_energy = true;
  /// True for a law that says `static constexpr bool explicit_hardening = true;`: the surface moves
  /// after the return, as published.
  bool explicit_hardening = false;
  double stiffness = 0;  ///< P-wave modulus of the initial state [Pa]: the scale of stresses
  std::unique_ptr<Point<double>> exact;
  std::unique_ptr<Point<float>> single;

  bool has_field(const std::string& field) const { return first_entry(field) >= 0; }
  /// Index of the field's first entry, or -1.
  int first_entry(const std::string& field) const;
  int entry_count() const;
  /// No history but the deformation: a path leaves no trace.
  bool path_independent() const;
};

/// A model with the parameters that it is tested with.
struct Family {
  std::string name;
  const SchemaBase* schema = nullptr;
  std::vector<std::any> inputs;
  void* (*input_pointer)(std::any&) = nullptr;
  Law (*make)(const std::any& input) = nullptr;

  std::vector<Law> laws() const;  ///< one an input
  /// `input` with another number, or nothing where that is outside of the key's range or not
  /// allowed by the checks of the schema.
  std::optional<std::any> changed(const std::any& input, const std::string& key,
                                  double value) const;
  std::optional<double> number(const std::any& input, const std::string& key) const;
};

/// All models of this build.
const std::vector<Family>& families();

/// The model `name` with its input number `sample`, in lanes.
template <class T>
std::unique_ptr<LaneLaw<T>> make_lane_law(const std::string& name, std::size_t sample);

/// Names of all models of this build.
std::vector<std::string> family_names();
const Family& find_family(const std::string& name);

}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include "solver/base/tensor.hpp"
#include "solver/element/path_spec.hpp"

namespace scree {
namespace {

using Names = std::vector<std::pair<std::string, LabTest>>;

const Names& names() {
  static const Names all{{"isotropic", LabTest::isotropic},
                         {"oedometer", LabTest::oedometer},
                         {"triaxial_drained", LabTest::triaxial_drained},
                         {"triaxial_undrained", LabTest::triaxial_undrained},
                         {"simple_shear", LabTest::simple_shear},
                         {"gradient", LabTest::gradient}};
  return all;
}

/// The paths that have a controlled strain.
const std::vector<std::string> strained{"isotropic", "oedometer", "triaxial_drained",
                                        "triaxial_undrained", "simple_shear"};

/// det F on the way from I to the final gradient, at the share s of it.
double determinant(const std::array<double, 9>& final_gradient, double s) {
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      f(i, j) += s * (final_gradient[static_cast<std::size_t>(3 * i + j)] - f(i, j));
    }
  }
  return det(f);
}

/// A determinant is a cubic of s: a thousand samples do not miss where it is negative by more than
/// rounding.
std::optional<Finding> gradient_fault(const PathSpec& path, const SchemaContext&) {
  if (path.type != LabTest::gradient) return std::nullopt;
  constexpr int samples = 1000;
  for (int i = 1; i <= samples; ++i) {
    const double s = double(i) / samples;
    const double value = determinant(path.gradient, s);
    if (value > 0) continue;
    char text[80];
    std::snprintf(text, sizeof text, "its determinant is %.3g after %.3g of the way", value, s);
    return Finding{"gradient", text, "above 0 on the straight way from the identity", ""};
  }
  return std::nullopt;
}

void add_strains(Schema<PathSpec>& s) {
  s.number("strain", &PathSpec::strain)
      .at_least(-5)
      .at_most(5)
      .when("type", {"isotropic"})
      .doc("Final volumetric logarithmic strain, compression positive, from the confined state.");
  s.number("strain", &PathSpec::strain)
      .at_least(-5)
      .at_most(5)
      .when("type", {"oedometer", "triaxial_drained", "triaxial_undrained"})
      .doc("Final axial logarithmic strain, compression positive, from the confined state.");
  s.number("strain", &PathSpec::strain)
      .at_least(-1000)
      .at_most(1000)
      .when("type", {"simple_shear"})
      .doc("Final shear strain g of F = [[1, g, 0], [0, l, 0], [0, 0, 1]].");
  s.number("unload", &PathSpec::unload)
      .when("type", strained)
      .doc("Strain to which the path goes back after strain; 0 closes a cycle of strain.");
  s.integer("cycles", &PathSpec::cycles)
      .at_least(1)
      .at_most(1000)
      .when("type", strained)
      .fallback(1)
      .doc("How often the path goes to strain and back to unload.");
}

void add_stresses(Schema<PathSpec>& s) {
  s.number("confining_pressure", &PathSpec::confining_pressure, Unit::pressure)
      .at_least(0)
      .fallback_text(
          "that of the material's initial state: 0, but for laws that have an "
          "initial_pressure")
      .doc(
          "Cauchy pressure to which the point is brought, equally in all directions, before the "
          "path begins. The path holds it on axes 2 and 3 in triaxial_drained, and in "
          "triaxial_undrained where the material has undrained_bulk_modulus.");
  s.number("normal_stress", &PathSpec::normal_stress, Unit::pressure)
      .above(0)
      .when("type", {"simple_shear"})
      .fallback_text("none: constant volume")
      .doc(
          "Cauchy stress on axis 2, compression positive, held during the shear by the stretch l. "
          "The confined point is first brought to it by a strain along axis 2 alone.");
}

void add_progress(Schema<PathSpec>& s) {
  s.integer("steps", &PathSpec::steps)
      .at_least(1)
      .at_most(10000000)
      .fallback(1000)
      .doc(
          "Equal increments of the controlled strain from the start to strain, and again from "
          "there to unload.");
  s.number("duration", &PathSpec::duration, Unit::time)
      .above(0)
      .fallback(1.0)
      .doc(
          "Time for these steps, for laws whose stress depends on the rate of strain. The stages "
          "before the path are slow: 1e6 times this.");
  s.number("initial_void_ratio", &PathSpec::initial_void_ratio)
      .at_least(0)
      .fallback(0.0)
      .doc(
          "Void ratio e0 of the undeformed material, for laws that do not know their own: the "
          "column void_ratio is then (1 + e0) J - 1.");
}

Schema<PathSpec> make_path_schema() {
  Schema<PathSpec> s("path",
                     "How `scree element` drives a material point: a laboratory test. Axis 1 is "
                     "the axial direction. The state of stress is three-dimensional.");
  s.choice("type", &PathSpec::type, names())
      .doc(
          "isotropic: equal strains; oedometer: axial strain without lateral strain; "
          "triaxial_drained: axial strain at constant lateral stress; triaxial_undrained: axial "
          "strain at constant volume (or, where the material has undrained_bulk_modulus, with "
          "water in the pores, at constant total lateral stress); simple_shear: at constant "
          "volume or constant normal_stress; gradient: to any deformation gradient. With "
          "undrained_bulk_modulus, water cannot leave the pores on any of these paths, and a held "
          "stress is the total one; triaxial_drained refuses it.");
  add_strains(s);
  s.matrix("gradient", &PathSpec::gradient)
      .when("type", {"gradient"})
      .doc("Final deformation gradient F, from the confined state; reached in equal increments.");
  add_stresses(s);
  add_progress(s);
  s.check({"type", "unload", "cycles"},
          [](const PathSpec& path, const SchemaContext&) -> std::optional<Finding> {
            if (path.cycles == 1 || path.unload) return std::nullopt;
            return Finding{"cycles", "needs unload", "", "add unload = ... to path"};
          });
  s.check({"type", "gradient"}, gradient_fault);
  return s;
}

}  // namespace

const char* lab_test_name(LabTest type) {
  for (const auto& [name, value] : names()) {
    if (value == type) return name.c_str();
  }
  return "";
}

const Schema<PathSpec>& path_schema() {
  static const Schema<PathSpec> schema = make_path_schema();
  return schema;
}

}  // namespace scree

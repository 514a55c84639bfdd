// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "solver/simulation/domain_spec.hpp"
#include "solver/simulation/method_spec.hpp"
#include "solver/simulation/time_spec.hpp"

namespace scree {
namespace {

const char* const axis_names[3] = {"x", "y", "z"};

/// Extents are compared in cells: what decimal numbers lose to rounding is far below this.
constexpr double cell_tolerance = 1e-6;

/// Grid indices are 32-bit, with room for halos and half steps.
constexpr double most_cells = 1e6;

/// A number as a person would write it: nine digits hide the rounding of lower + n cell_size.
std::string short_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

/// The upper bound of `axis` with `cells` cells, one at least.
double upper_with(const DomainSpec& domain, std::size_t axis, double cells) {
  return domain.lower[axis] + std::max(1.0, cells) * domain.cell_size;
}

/// "upper = [0.8, 0.3]" with `value` in `axis`; the other axes at their nearest whole cells.
std::string upper_text(const DomainSpec& domain, std::size_t axis, double value) {
  std::string text = "upper = [";
  for (std::size_t i = 0; i < static_cast<std::size_t>(domain.dimension); ++i) {
    const double cells = (domain.upper[i] - domain.lower[i]) / domain.cell_size;
    const double nearest = upper_with(domain, i, std::round(cells));
    text += (i == 0 ? "" : ", ") + short_number(i == axis ? value : nearest);
  }
  return text + "]";
}

std::optional<Finding> extent_fault(const DomainSpec& domain, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  const double extent = domain.upper[k] - domain.lower[k];
  const std::string name = axis_names[axis];
  if (!(extent > 0)) {
    return Finding{"upper", "is not above domain.lower in " + name,
                   "more than " + short_number(domain.lower[k]), ""};
  }
  const double cells = extent / domain.cell_size;
  if (cells > most_cells) {
    return Finding{"cell_size", "gives " + short_number(std::round(cells)) + " cells in " + name,
                   "at most " + short_number(most_cells) + " cells an axis", "enlarge the cells"};
  }
  const double nearest = std::round(cells);
  if (nearest >= 1 && std::abs(cells - nearest) <= cell_tolerance) return std::nullopt;
  std::string allowed = upper_text(domain, k, upper_with(domain, k, std::ceil(cells)));
  if (cells > 1) {
    allowed = upper_text(domain, k, upper_with(domain, k, std::floor(cells))) + " or " + allowed;
  }
  const std::string size = short_number(domain.cell_size);
  return Finding{"upper",
                 "upper - lower = " + short_number(extent) + " m in " + name +
                     " is no multiple of cell_size = " + size + " m (" + short_number(cells) +
                     " cells)",
                 allowed, ""};
}

Schema<DomainSpec> make_domain_schema() {
  Schema<DomainSpec> s("domain", "The box that holds the grid; material outside it is lost.");
  s.integer("dimension", &DomainSpec::dimension)
      .at_least(2)
      .at_most(3)
      .doc("2 is plane strain (per metre of thickness), 3 is three-dimensional.");
  s.vector("lower", &DomainSpec::lower, Unit::length).doc("Lower corner.");
  s.vector("upper", &DomainSpec::upper, Unit::length)
      .doc("Upper corner; upper - lower must be a multiple of cell_size in every axis.");
  s.number("cell_size", &DomainSpec::cell_size, Unit::length)
      .above(0)
      .doc("Edge of the square or cubic cells.");
  for (int axis = 0; axis < 3; ++axis) {
    s.check({"dimension", "lower", "upper", "cell_size"},
            [axis](const DomainSpec& domain, const SchemaContext&) -> std::optional<Finding> {
              if (axis >= domain.dimension) return std::nullopt;
              return extent_fault(domain, axis);
            });
  }
  return s;
}

Schema<TimeSpec> make_time_schema() {
  Schema<TimeSpec> s("time", "How long the simulation runs, and in which steps.");
  s.number("end", &TimeSpec::end, Unit::time).above(0).doc("Simulated time.");
  s.number("cfl", &TimeSpec::cfl)
      .above(0)
      .at_most(0.5)
      .fallback(0.4)
      .doc(
          "Step length as a fraction of cell_size / max(wave speed + particle speed). Fluids have "
          "another bound, that of drops on their own: with the compact kernel and mls 0.257 in "
          "3D.");
  s.number("step", &TimeSpec::step, Unit::time)
      .above(0)
      .doc(
          "A fixed step in place of cfl; you answer for its stability. Steps are still shortened "
          "to hit output times.");
  return s;
}

Schema<DampingSpec> make_damping_schema() {
  Schema<DampingSpec> s("damping", "Artificial damping, to reach equilibrium.");
  s.shorthand_number("value");
  s.choice("type", &DampingSpec::type, {{"local", DampingType::local}, {"mass", DampingType::mass}})
      .fallback(DampingType::local)
      .doc(
          "local: Cundall's, a fraction of the out-of-balance force against the motion; mass: "
          "proportional to momentum.");
  s.number("value", &DampingSpec::value)
      .at_least(0)
      .below(1)
      .when("type", {"local"})
      .fallback(0.0)
      .doc("Fraction of the out-of-balance force; 0 is no damping.");
  s.number("value", &DampingSpec::value, Unit::rate)
      .at_least(0)
      .when("type", {"mass"})
      .fallback(0.0)
      .doc("Rate at which momentum decays; 0 is no damping.");
  return s;
}

void add_loads(Schema<MethodSpec>& s) {
  s.formulas("gravity", &MethodSpec::gravity, Unit::acceleration, {"t"})
      .fallback({Formula{"0.0"}, Formula{"0.0"}, Formula{"0.0"}})
      .doc("Gravity; entries may be expressions of t.");
  s.formulas("body_force", &MethodSpec::body_force, Unit::acceleration,
             {"X", "Y", "Z", "x", "y", "z", "t"})
      .fallback_text("none")
      .doc(
          "Body force per mass at each particle; X, Y, Z is its reference position, x, y, z its "
          "present one.");
  s.table("damping", &MethodSpec::damping, &damping_schema)
      .fallback_text("none")
      .doc("A table, or a bare number, which means local damping.");
}

std::optional<Finding> singular_transfer(const MethodSpec& method, const SchemaContext&) {
  const bool affine = method.transfer == TransferType::mls || method.transfer == TransferType::apic;
  if (method.kernel != KernelType::linear || !affine) return std::nullopt;
  return Finding{"kernel",
                 "the linear kernel cannot be combined with transfer mls or apic, because its "
                 "matrix D is singular where a particle meets a node",
                 "compact, quadratic", "or set transfer = \"flip\" or \"pic\""};
}

void add_choices(Schema<MethodSpec>& s) {
  s.choice("volumetric_locking", &MethodSpec::volumetric_locking,
           {{"none", VolumetricLocking::none}, {"fbar", VolumetricLocking::fbar}})
      .fallback(VolumetricLocking::none)
      .doc(
          "fbar: laws see changes of volume averaged over the nodes around a particle, so that "
          "nearly incompressible materials (plastic flow without change of volume, undrained clay, "
          "Poisson's ratio near 0.5) flow under their own load, not a multiple of it. With "
          "[coupling] it is the effective stress that sees them; the volume of the pores is the "
          "particle's own. Computed by the processor, in separate passes.");
  s.flag("deterministic", &MethodSpec::deterministic)
      .fallback(false)
      .doc(
          "The same bits in every run on a GPU, too, where sums are then in fixed point and the "
          "step "
          "is split in two passes, which is slower. Runs on the processor always are.");
}

Schema<MethodSpec> make_method_schema() {
  Schema<MethodSpec> s("method", "The numerical method and what acts on everything.");
  s.choice("kernel", &MethodSpec::kernel,
           {{"compact", KernelType::compact},
            {"quadratic", KernelType::quadratic},
            {"linear", KernelType::linear}})
      .fallback(KernelType::compact)
      .doc(
          "compact: dual grid (Liu et al. 2025); quadratic: B-spline; linear: a baseline that "
          "shows the cell-crossing error.");
  s.choice("transfer", &MethodSpec::transfer,
           {{"mls", TransferType::mls},
            {"apic", TransferType::apic},
            {"flip", TransferType::flip},
            {"pic", TransferType::pic}})
      .fallback(TransferType::mls)
      .doc("How particles and grid exchange momentum; the linear kernel takes flip or pic.");
  s.choice("precision", &MethodSpec::precision,
           {{"double", Precision::double_}, {"single", Precision::single_}})
      .fallback(Precision::double_)
      .doc("Floating-point type of particles and grid.");
  s.number("flip_blend", &MethodSpec::flip_blend)
      .at_least(0)
      .at_most(1)
      .when("transfer", {"flip"})
      .fallback(0.95)
      .doc("Share of flip; the rest is pic.");
  add_choices(s);
  add_loads(s);
  s.check({"kernel", "transfer"}, singular_transfer);
  s.cite(
      "M. Liu, X. Wang, M. Li, CK-MPM: A Compact-Kernel Material Point Method, ACM TOG 44(4), "
      "2025, doi 10.1145/3731155");
  return s;
}

}  // namespace

double cell_count(const DomainSpec& domain, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  return std::round((domain.upper[k] - domain.lower[k]) / domain.cell_size);
}

const Schema<DomainSpec>& domain_schema() {
  static const Schema<DomainSpec> schema = make_domain_schema();
  return schema;
}

const Schema<TimeSpec>& time_schema() {
  static const Schema<TimeSpec> schema = make_time_schema();
  return schema;
}

const Schema<DampingSpec>& damping_schema() {
  static const Schema<DampingSpec> schema = make_damping_schema();
  return schema;
}

const Schema<MethodSpec>& method_schema() {
  static const Schema<MethodSpec> schema = make_method_schema();
  return schema;
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/initial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "materials/initial_state.hpp"
#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/base/value.hpp"
#include "solver/deck/expression.hpp"

namespace scree {
namespace {

using Stress = std::array<double, 3>;

std::string short_number(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

std::string vector_text(const double* x, int count) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + short_number(x[i]);
  return text + "]";
}

/// The law of a body, for any number of stresses.
class Law {
 public:
  Law(const Deck& deck, const MaterialSpec& material)
      : deck_(deck), material_(material), entry_(*find_material_model(material.model)) {}

  std::optional<std::vector<double>> state(const Stress& stress) const {
    if (entry_.state_under) return entry_.state_under(material_.input, stress);
    const auto point = make_material_point(material_.model, material_.input, material_.density,
                                           deck_.domain.dimension);
    return initial_state(*point, entry_.fields, stress);
  }
  bool carries(const Stress& stress) const { return state(stress).has_value(); }
  /// What helps where no k0 does.
  std::string repair() const {
    return entry_.stress_repair ? entry_.stress_repair(material_.input)
                                : "change the strength of the material";
  }

 private:
  const Deck& deck_;
  const MaterialSpec& material_;
  const MaterialEntry& entry_;
};

/// Edge between a k0 that the law carries at x and one that it does not.
double edge(const Law& law, InitialStress field, const double* x, double good, double bad) {
  for (int i = 0; i < 40 && std::abs(good - bad) > 1e-4 * good; ++i) {
    const double middle = 0.5 * (good + bad);
    field.set_k0(middle);
    (law.carries(field.at(x)) ? good : bad) = middle;
  }
  return good;
}

/// Which k0 the law would carry at x.
std::string possible_k0(const Law& law, InitialStress field, const double* x) {
  constexpr int tried = 41;  // 0.05 to 20 in steps of 16 %
  std::vector<double> good;
  const auto k = [](int i) { return 0.05 * std::pow(400.0, i / double(tried - 1)); };
  int first = -1, last = -1;
  for (int i = 0; i < tried; ++i) {
    field.set_k0(k(i));
    if (!law.carries(field.at(x))) continue;
    if (first < 0) first = i;
    last = i;
  }
  if (first < 0) return {};
  const double low = first == 0 ? k(0) : edge(law, field, x, k(first), k(first - 1));
  const double high = last == tried - 1 ? k(last) : edge(law, field, x, k(last), k(last + 1));
  if (high - low < 1e-3) return "k0 = " + short_number(0.5 * (low + high));
  return "k0 of " + short_number(low) + " to " + short_number(high);
}

Finding above_surface(const InitialStress& field, const double* x) {
  const double missing = -field.depth(x);
  return {"surface", "a particle lies " + short_number(missing) + " m above it", "",
          "move the surface to the top of the body, or cut the body there"};
}

Finding not_carried(const Law& law, const InitialStress& field, const MaterialSpec& material,
                    const double* x, int dimension) {
  const Stress stress = field.at(x);
  std::string message = "model " + material.model + " has no elastic state with the " +
                        (field.total() ? "effective stress " : "stress ") +
                        vector_text(stress.data(), 3) + " Pa";
  if (field.total()) {
    return {"value",
            message + " at " + vector_text(x, dimension) + " m, where the pore pressure is " +
                short_number(field.pressure(x)) + " Pa",
            "effective stresses inside the yield surface, of a kind that the law carries",
            "change the stress or the pressure, or " + law.repair()};
  }
  if (!field.geostatic()) {
    return {"value", message, "stresses inside the yield surface, of a kind that the law carries",
            "change the stress, or " + law.repair()};
  }
  message += " at " + vector_text(x, dimension) + " m";
  const std::string possible = possible_k0(law, field, x);
  return {"", message + ", k0 = " + short_number(field.k0()), possible,
          (possible.empty() ? "" : "set k0, or ") + law.repair()};
}

/// Index of the particles that are tried: highest, lowest, some between; of a total stress those of
/// the least and the largest pore pressure, between which all effective stresses lie.
std::vector<std::size_t> sample_of(const InitialStress& field,
                                   const std::vector<double>& position) {
  constexpr std::size_t most = 24;
  if (!field.geostatic() && !field.total()) return {0};
  std::vector<std::size_t> order(position.size() / 3);
  std::vector<double> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double* x = &position[3 * i];
    order[i] = i;
    rank[i] = field.total() ? field.pressure(x) : field.depth(x);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank[a] < rank[b]; });
  if (order.size() <= most) return order;
  std::vector<std::size_t> sample;
  for (std::size_t i = 0; i < most; ++i) {
    sample.push_back(order[i * (order.size() - 1) / (most - 1)]);
  }
  return sample;
}

}  // namespace

std::array<double, 3> gravity_at_start(const Deck& deck) {
  std::array<double, 3> gravity{};
  for (std::size_t a = 0; a < std::size_t(deck.domain.dimension); ++a) {
    const Formula& formula = deck.method.gravity[a];
    const double start = 0;
    if (formula.given()) gravity[a] = Expression(formula.text, {"t"})(&start);
  }
  return gravity;
}

int gravity_axis(const Deck& deck) {
  const std::array<double, 3> gravity = gravity_at_start(deck);
  int axis = -1;
  for (int a = 0; a < 3; ++a) {
    if (gravity[std::size_t(a)] == 0) continue;
    if (axis >= 0) return -1;
    axis = a;
  }
  return axis;
}

InitialStress::InitialStress(const Deck& deck, const BodySpec& body, const MaterialSpec& material)
    : spec_(*body.initial_stress), pressure_(deck, material) {
  if (!geostatic()) return;
  axis_ = gravity_axis(deck);
  const double gravity = gravity_at_start(deck)[std::size_t(axis_)];
  down_ = gravity < 0 ? -1 : 1;
  weight_ = material.density * std::abs(gravity);
  k0_ = spec_.k0 ? *spec_.k0 : find_material_model(material.model)->rest_ratio(material.input);
}

std::array<double, 3> InitialStress::at(const double* x) const {
  if (!geostatic()) {
    Stress stress = spec_.value;
    if (!spec_.total) return stress;
    for (double& normal : stress) normal += pressure_.biot() * pressure_.at(x);
    return stress;
  }
  double surface[3] = {x[0], x[1], x[2]};
  surface[axis_] = spec_.surface;
  const double total = -weight_ * depth(x) - pressure_.at(surface);
  const double vertical = total + pressure_.biot() * pressure_.at(x);
  Stress stress{k0_ * vertical, k0_ * vertical, k0_ * vertical};
  stress[std::size_t(axis_)] = vertical;
  return stress;
}

InitialStates solve_initial_states(const Deck& deck, const BodySpec& body,
                                   const std::vector<double>& position) {
  const MaterialSpec& material = *deck.find_material(body.material);
  const InitialStress field(deck, body, material);
  const Law law(deck, material);
  InitialStates result;
  std::map<Stress, std::int32_t> known;
  for (std::size_t p = 0; p < position.size(); p += 3) {
    const Stress stress = field.at(&position[p]);
    const auto [place, fresh] = known.try_emplace(stress, std::int32_t(known.size()));
    if (fresh) {
      auto state = law.state(stress);
      if (!state) {
        const Finding fault =
            not_carried(law, field, material, &position[p], deck.domain.dimension);
        throw UserError("body " + body.name + ": " + fault.message);
      }
      result.states.push_back(std::move(*state));
    }
    result.state_of.push_back(place->second);
  }
  return result;
}

std::optional<Finding> initial_stress_fault(const Deck& deck, const BodySpec& body,
                                            const std::vector<double>& position) {
  const MaterialSpec& material = *deck.find_material(body.material);
  const InitialStress field(deck, body, material);
  const Law law(deck, material);
  if (position.empty()) return std::nullopt;
  for (const std::size_t p : sample_of(field, position)) {
    const double* x = &position[3 * p];
    // The highest comes first. A particle on the surface carries nothing; rounding may lift it.
    if (field.geostatic() && field.depth(x) < -1e-9 * deck.domain.cell_size) {
      return above_surface(field, x);
    }
    if (law.carries(field.at(x))) continue;
    return not_carried(law, field, material, x, deck.domain.dimension);
  }
  return std::nullopt;
}

}  // namespace scree

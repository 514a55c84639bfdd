// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/deck_checks.hpp"

#include <algorithm>
#include <cmath>

#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/coupling_checks.hpp"
#include "solver/deck/expression.hpp"
#include "solver/deck/initial_stress.hpp"
#include "solver/deck/key_text.hpp"
#include "solver/deck/particle_faults.hpp"
#include "solver/deck/record_faults.hpp"
#include "solver/particles/sampling.hpp"
#include "solver/particles/shape.hpp"
#include "solver/simulation/particle_fields.hpp"

namespace scree {
namespace {

template <class Specs>
std::vector<std::string> names_of(const Specs& specs) {
  std::vector<std::string> names;
  names.reserve(specs.size());
  for (const auto& spec : specs) names.push_back(spec.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Checker {
 public:
  Checker(const Deck& deck, const Value& document, Problems& problems)
      : deck_(deck), document_(document), problems_(problems) {}

  void run() {
    check_presence();
    check_names();
    check_references();
    check_step();
    check_gravity();
    check_collider_velocities();
    check_fields();
    check_series();
    check_records();
    for (const BodySpec& body : deck_.bodies) {
      check_place(body);
    }
  }

 private:
  /// The value at a path of keys, or the innermost table there is.
  const Value& at(const std::vector<std::string>& path) const {
    const Value* value = &document_;
    for (const std::string& key : path) {
      const Value* next = value->find(key);
      if (next == nullptr) break;
      value = next;
    }
    return *value;
  }

  void report(const std::vector<std::string>& path, const std::string& message,
              const std::string& allowed = {}, const std::string& repair = {}) {
    const Value& value = at(path);
    const std::string key = key_text(path);
    const bool shown = !value.items.empty() || !value.is(Value::Kind::table);
    std::string text = shown && &value != &document_ ? to_toml(value) : std::string();
    if (text.size() > 70) text = text.substr(0, 67) + "...";
    problems_.add({value.position, key, text, message, allowed, repair});
  }

  bool faulty(const std::string& key) const { return problems_.any_under(key); }

  void check_presence() {
    if (deck_.materials.empty() && !faulty("material")) {
      report({"material"}, "has no material", "", "add [material.NAME]");
    }
    if (deck_.bodies.empty() && !faulty("body")) {
      report({"body"}, "has no body", "", "add [body.NAME]");
    }
  }

  void check_names() {
    check_names("material", names_of(deck_.materials));
    check_names("body", names_of(deck_.bodies));
    check_names("traction", names_of(deck_.tractions));
    check_names("collider", names_of(deck_.colliders));
    check_names("frames", names_of(deck_.frames));
    check_names("probe", names_of(deck_.probes));
    check_names("profile", names_of(deck_.profiles));
    check_names("section", names_of(deck_.sections));
    check_names("drainage", names_of(deck_.drainage));
  }

  /// Names become column names and labels.
  void check_names(const std::string& table, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (!name.empty() && toml_key(name) == name) continue;
      report({table, name}, "the name is not usable in tables", "letters, digits, _ and -",
             "choose another name");
    }
  }

  void check_reference(const std::vector<std::string>& path, const std::string& name,
                       const std::string& table, const std::vector<std::string>& names) {
    if (name.empty() || contains(names, name) || names.empty()) return;
    const std::string near = did_you_mean(name, names);
    report(path, "there is no [" + table + "." + name + "]", join(names),
           near.empty() ? "add it, or name another" : "did you mean \"" + near + "\"?");
  }

  void check_references() {
    for (const BodySpec& body : deck_.bodies) {
      check_reference({"body", body.name, "material"}, body.material, "material",
                      names_of(deck_.materials));
    }
    for (const TractionSpec& traction : deck_.tractions) {
      check_reference({"traction", traction.name, "body"}, traction.body, "body",
                      names_of(deck_.bodies));
    }
    for (const DrainageSpec& drainage : deck_.drainage) {
      check_reference({"drainage", drainage.name, "body"}, drainage.body, "body",
                      names_of(deck_.bodies));
    }
  }

  void check_step() {
    if (!deck_.time.step || !deck_.given.contains("time.cfl")) return;
    report({"time", "step"}, "is given together with time.cfl, but either fixes the step", "",
           "remove one of them");
  }

  void check_gravity() {
    if (faulty("method.gravity")) return;
    for (int i = 0; i < deck_.domain.dimension; ++i) {
      const Formula& formula = deck_.method.gravity[static_cast<std::size_t>(i)];
      if (!formula.given()) return;
      const Expression expression(formula.text, {"t"});
      const double start = 0, value = expression(&start);
      if (!std::isfinite(value)) {
        report({"method", "gravity"}, "\"" + formula.text + "\" is not finite at t = 0");
        return;
      }
    }
    for (const BodySpec& body : deck_.bodies) {
      const auto& stress = body.initial_stress;
      if (!stress || stress->type != InitialStressType::geostatic) continue;
      if (gravity_axis(deck_) >= 0) continue;
      report({"body", body.name, "initial_stress"},
             "geostatic stress needs a method.gravity that is along one axis at t = 0", "",
             "set method.gravity, or use type = \"uniform\"");
    }
  }

  void check_collider_velocities() {
    const double start = 0;
    for (const ColliderSpec& collider : deck_.colliders) {
      if (faulty("collider." + toml_key(collider.name) + ".velocity")) continue;
      for (const Formula& formula : collider.velocity) {
        if (!formula.given() || std::isfinite(Expression(formula.text, {"t"})(&start))) continue;
        report({"collider", collider.name, "velocity"},
               "\"" + formula.text + "\" is not finite at t = 0");
      }
    }
  }

  std::vector<std::string> field_names() const {
    std::vector<std::string> names{"id", "material", "body"};
    FieldWater water = FieldWater::none;
    for (const MaterialSpec& material : deck_.materials) {
      if (material.undrained_bulk_modulus) water = std::max(water, FieldWater::any);
      if (material.porosity) water = FieldWater::flowing;
    }
    for (const ParticleField& field : particle_fields()) {
      if (field.water <= water) names.push_back(field.name);
    }
    for (const MaterialSpec& material : deck_.materials) {
      const MaterialEntry* model = find_material_model(material.model);
      if (model == nullptr) continue;
      for (const StateField& field : model->fields) {
        if (field.output && !contains(names, field.name)) names.push_back(field.name);
      }
    }
    return names;
  }

  void check_fields() {
    for (const MaterialSpec& material : deck_.materials) {
      if (find_material_model(material.model) == nullptr) return;
    }
    if (deck_.materials.empty()) return;
    const auto known = field_names();
    check_fields({"output"}, deck_.output.fields, known);
    check_all_fields("frames", deck_.frames, known);
    check_all_fields("probe", deck_.probes, known);
    check_all_fields("profile", deck_.profiles, known);
    check_all_fields("section", deck_.sections, known);
  }

  template <class Specs>
  void check_all_fields(const std::string& table, const Specs& specs,
                        const std::vector<std::string>& known) {
    for (const auto& spec : specs) check_fields({table, spec.name}, spec.fields, known);
  }

  void check_fields(std::vector<std::string> path, const std::vector<std::string>& fields,
                    const std::vector<std::string>& known) {
    path.emplace_back("fields");
    if (faulty(key_text(path))) return;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const bool again = std::find(fields.begin(), fields.begin() + static_cast<long>(i),
                                   fields[i]) != fields.begin() + static_cast<long>(i);
      const std::string near = did_you_mean(fields[i], known);
      if (contains(known, fields[i]) && !again) continue;
      report_item(path, i, again ? "is named twice" : "is no field of the materials in use",
                  again ? "" : join(known),
                  near.empty() || again ? "remove it" : "did you mean \"" + near + "\"?");
    }
  }

  void report_item(const std::vector<std::string>& path, std::size_t index,
                   const std::string& message, const std::string& allowed,
                   const std::string& repair) {
    const Value& list = at(path);
    const Value& item = index < list.items.size() ? list.items[index] : list;
    problems_.add({item.position, key_text(path) + "[" + std::to_string(index) + "]", to_toml(item),
                   message, allowed, repair});
  }

  void check_series() {
    std::vector<std::string> files{"particles", "grid"};
    for (const OutputSpec& frames : deck_.frames) {
      for (const std::string& name : {frames.name, frames.grid_name()}) {
        if (!contains(files, name)) continue;
        report({"frames", frames.name}, "there are other files called " + name, "",
               "choose another name");
        break;
      }
      files.insert(files.end(), {frames.name, frames.grid_name()});
    }
    check_window({"output"}, deck_.output);
    for (const OutputSpec& frames : deck_.frames) check_window({"frames", frames.name}, frames);
  }

  void check_window(std::vector<std::string> path, const OutputSpec& spec) {
    path.emplace_back("from");
    if (faulty("time.end") || faulty(key_text(path)) || !(spec.from > deck_.time.end)) return;
    report(path, "is after time.end, so there would be no frame",
           "at most " + toml_number(deck_.time.end) + " s");
  }

  void check_records() {
    for (const RecordFault& fault : record_faults(deck_, problems_)) {
      report(fault.path, fault.message, fault.allowed, fault.repair);
    }
  }

  /// Positions: of all particles, or corners of a large body.
  void check_initial_stress(const BodySpec& body, const std::vector<double>& position) {
    const std::string key = "body." + toml_key(body.name);
    const MaterialSpec* material = deck_.find_material(body.material);
    if (!body.initial_stress || faulty(key + ".initial_stress") || faulty("method.gravity")) return;
    if (!material || faulty("material." + toml_key(material->name))) return;
    if (faulty("coupling.initial_pressure") || faulty("coupling.water_table")) return;
    const auto fault = initial_stress_fault(deck_, body, position);
    if (!fault) return;
    std::vector<std::string> path{"body", body.name, "initial_stress"};
    if (!fault->key.empty()) path.push_back(fault->key);
    report(path, fault->message, fault->allowed, fault->repair);
  }

  void check_place(const BodySpec& body) {
    const std::string key = "body." + toml_key(body.name);
    if (faulty("domain") || faulty(key + ".shape") || faulty(key + ".particles_per_direction")) {
      return;
    }
    const int dimension = deck_.domain.dimension;
    const auto shape = make_shape(body.shape, dimension);
    const Box box = shape->bounds();
    if (!box.bounded(dimension)) {
      report({"body", body.name, "shape"}, "is unbounded", "",
             "combine the plane with a bounded shape");
      return;
    }
    if (outside(box)) {
      report({"body", body.name, "shape"},
             "reaches from " + point_text(box.lower, dimension) + " to " +
                 point_text(box.upper, dimension) + " m, out of the domain",
             point_text(deck_.domain.lower, dimension) + " to " +
                 point_text(deck_.domain.upper, dimension) + " m",
             "move or shrink the shape, or enlarge the domain");
      return;
    }
    check_particles(body, *shape, box);
  }

  bool outside(const Box& box) const {
    const double tolerance = 1e-6 * deck_.domain.cell_size;
    for (std::size_t i = 0; i < static_cast<std::size_t>(deck_.domain.dimension); ++i) {
      if (box.lower[i] < deck_.domain.lower[i] - tolerance ||
          box.upper[i] > deck_.domain.upper[i] + tolerance) {
        return true;
      }
    }
    return false;
  }

  void check_particles(const BodySpec& body, const Shape& shape, const Box& box) {
    // Large bodies are not sampled here: a shape of a million lattice sites that holds none of
    // them would be strange, and the run samples it anyway.
    constexpr double most_sites = 1e6;
    const int dimension = deck_.domain.dimension;
    const double spacing = deck_.domain.cell_size / body.particles_per_direction;
    double sites = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
      sites *= (box.upper[i] - box.lower[i]) / spacing + 1;
    }
    if (sites > most_sites) {
      std::vector<double> corners;  // the first and the last site inside
      for (const double x : box.lower) corners.push_back(x + 0.5 * spacing);
      for (const double x : box.upper) corners.push_back(x - 0.5 * spacing);
      return check_initial_stress(body, corners);
    }
    const auto particles = sample(shape, deck_.domain.lower, deck_.domain.cell_size,
                                  body.particles_per_direction, dimension);
    if (particles.count() > 0) {
      check_formulas(body, particles);
      check_initial_stress(body, particles.position);
      return;
    }
    report({"body", body.name, "shape"}, "holds no particle", "",
           "enlarge the shape, lower domain.cell_size (particles are cell_size / "
           "particles_per_direction = " +
               toml_number(spacing) + " m apart), or raise particles_per_direction");
  }

  /// Formulas and loads at the particles.
  void check_formulas(const BodySpec& body, const SampledBody& particles) {
    for (const BodyFault& fault : particle_faults(deck_, body, particles, problems_)) {
      report(fault.path, fault.message, "", fault.repair);
    }
  }

  const Deck& deck_;
  const Value& document_;
  Problems& problems_;
};

}  // namespace

void check_deck(const Deck& deck, const Value& document, Problems& problems) {
  check_coupling(deck, document, problems);
  Checker(deck, document, problems).run();
}

}  // namespace scree

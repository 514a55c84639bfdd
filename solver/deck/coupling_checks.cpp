// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/coupling_checks.hpp"

#include <algorithm>
#include <cmath>

#include "materials/registry.hpp"
#include "solver/coupling/pressure_solver.hpp"
#include "solver/deck/initial_stress.hpp"
#include "solver/deck/key_text.hpp"
#include "solver/deck/pore_keys.hpp"
#include "solver/particles/shape.hpp"

namespace scree {
namespace {

class Checker {
 public:
  Checker(const Deck& deck, const Value& document, Problems& problems)
      : deck_(deck), document_(document), problems_(problems) {}

  void run() {
    bool water = false;
    for (const MaterialSpec& material : deck_.materials) {
      if (problems_.any_under("material." + toml_key(material.name))) continue;
      check_material(material);
      water = water || material.porosity.has_value();
    }
    for (const DrainageSpec& drainage : deck_.drainage) check_drainage(drainage);
    for (const BodySpec& body : deck_.bodies) check_total_stress(body);
    if (!deck_.coupling || problems_.any_under("coupling")) return;
    if (!water && !problems_.any_under("material")) {
      report({"coupling"}, "no material has a porosity, so that no water flows", "",
             "set the porosity of a material, or remove [coupling]");
    }
    check_method();
    check_pressure();
    check_solver();
  }

 private:
  const Value* find(const std::vector<std::string>& path) const {
    const Value* value = &document_;
    for (const std::string& key : path) {
      value = value->find(key);
      if (value == nullptr) return nullptr;
    }
    return value;
  }

  void report(const std::vector<std::string>& path, const std::string& message,
              const std::string& allowed, const std::string& repair) {
    std::vector<std::string> place = path;
    const Value* value = find(place);
    while (value == nullptr) {
      place.pop_back();
      value = find(place);
    }
    const bool shown = place.size() == path.size() && !value->is(Value::Kind::table);
    problems_.add(
        {value->position, key_text(path), shown ? to_toml(*value) : "", message, allowed, repair});
  }

  void check_material(const MaterialSpec& material) {
    const std::vector<std::string> path{"material", material.name};
    const auto at = [&](const char* key) {
      return std::vector<std::string>{"material", material.name, key};
    };
    if (!material.porosity) {
      for (const std::string& key : pore_key_names()) {
        if (find(at(key.c_str())) == nullptr) continue;
        report(at(key.c_str()), "belongs to pores, but the material has no porosity", "",
               "add porosity, or remove it");
      }
      return;
    }
    if (!deck_.coupling) {
      if (!problems_.any_under("coupling")) {
        report(at("porosity"), "water flows only with [coupling]", "",
               "add [coupling] with type = \"biot\", or remove it");
      }
      return;
    }
    if (material.undrained_bulk_modulus) {
      report(at("undrained_bulk_modulus"), "is water that stays, but porosity is water that flows",
             "", "remove one of them");
    }
    check_permeability(material, at);
    const double porosity = *material.porosity;
    if (material.biot_coefficient && *material.biot_coefficient < porosity) {
      report(at("biot_coefficient"), "is less than the porosity",
             "at least " + toml_number(porosity) + " and at most 1", "raise it");
    }
    const double water = porosity * material.pores()->fluid_density;
    if (material.density <= water) {
      report(at("density"), "is that of soil and water together, but the water alone has more",
             "above " + toml_number(water) + " kg/m^3",
             "give (1 - porosity) x density of the grains + porosity x fluid_density");
    }
  }

  template <class At>
  void check_permeability(const MaterialSpec& material, At&& at) {
    const bool conductivity = material.hydraulic_conductivity.has_value();
    const bool permeability = material.permeability.has_value();
    const bool viscosity = material.fluid_viscosity.has_value();
    if (conductivity && (permeability || viscosity)) {
      report(at(permeability ? "permeability" : "fluid_viscosity"),
             "is given together with hydraulic_conductivity, which says the same", "",
             "keep either hydraulic_conductivity or permeability with fluid_viscosity");
    } else if (!conductivity && permeability != viscosity) {
      report(at(permeability ? "permeability" : "fluid_viscosity"),
             permeability ? "needs fluid_viscosity" : "needs permeability", "",
             permeability ? "add fluid_viscosity (water: 1e-3 Pa s)" : "add permeability");
    } else if (!conductivity && !permeability) {
      report(at("porosity"), "needs to know how easily water flows", "",
             "add hydraulic_conductivity (m/s), or permeability (m^2) and fluid_viscosity (Pa s)");
    }
  }

  void check_drainage(const DrainageSpec& drainage) {
    const std::string key = "drainage." + toml_key(drainage.name);
    if (problems_.any_under(key)) return;
    if (!deck_.coupling) {
      report({"drainage", drainage.name}, "water flows only with [coupling]", "",
             "add [coupling], or remove it");
      return;
    }
    for (const BodySpec& body : deck_.bodies) {
      if (body.name != drainage.body) continue;
      const MaterialSpec* material = deck_.find_material(body.material);
      if (material == nullptr || material->porosity) return;
      report({"drainage", drainage.name, "body"},
             "material " + material->name + " of this body has no porosity", "",
             "set its porosity, or name another body");
      return;
    }
  }

  /// A total stress needs a pore pressure that it can differ by.
  void check_total_stress(const BodySpec& body) {
    if (!body.initial_stress || !body.initial_stress->total) return;
    if (problems_.any_under(key_text({"body", body.name, "initial_stress"}))) return;
    const MaterialSpec* material = deck_.find_material(body.material);
    if (material == nullptr || material->porosity) return;  // without [coupling]: its porosity's
    if (problems_.any_under("material." + toml_key(material->name))) return;
    const bool undrained = material->undrained_bulk_modulus.has_value();
    const bool may_have_pores = find_material_model(material->model)->effective_stress;
    const std::string pores = deck_.coupling ? ", or set the porosity of the material"
                                             : ", or set the porosity of the material and add "
                                               "[coupling]";
    report({"body", body.name, "initial_stress", "total"},
           undrained
               ? "the pore pressure of undrained_bulk_modulus starts from zero, so that total "
                 "and effective stress are the same"
               : "no water flows in material " + material->name +
                     ", so that total and effective stress are the same",
           "", "remove it" + (may_have_pores && !undrained ? pores : ""));
  }

  void check_method() {
    if (deck_.method.damping.type == DampingType::local && deck_.method.damping.value > 0) {
      report({"method", "damping"},
             "local damping takes a share of the out-of-balance force, which is not known before "
             "the pressure is",
             "mass", "set damping = { type = \"mass\", value = ... } (1/s), or remove it");
    }
    const int spacing = deck_.coupling->pressure_spacing;
    for (int axis = 0; axis < deck_.domain.dimension; ++axis) {
      if (deck_.boundary.face(axis, 0).type != FaceType::periodic) continue;
      const auto cells = cell_count(deck_.domain, axis);
      if (std::llround(double(cells)) % spacing == 0) continue;
      report({"coupling", "pressure_spacing"},
             "does not divide the number of cells between the periodic faces, " +
                 std::to_string(std::llround(double(cells))),
             "", "set it to 1, or make that number even");
    }
  }

  void check_pressure() {
    const CouplingSpec& coupling = *deck_.coupling;
    if (coupling.water_table && gravity_axis(deck_) < 0 && !problems_.any_under("method.gravity")) {
      report({"coupling", "water_table"}, "needs a method.gravity that is along one axis at t = 0",
             "", "set method.gravity, or use initial_pressure");
    }
  }

  void check_solver() {
    const CouplingSpec& coupling = *deck_.coupling;
    const std::string wrong = wrong_solver_options(
        coupling.preconditioner.empty() ? default_preconditioner(deck_.domain.dimension)
                                        : coupling.preconditioner,
        coupling.solver_options);
    if (wrong.empty()) return;
    report({"coupling", "solver_options"}, wrong, "",
           "correct or remove it, here or in the environment variable PETSC_OPTIONS");
  }

  const Deck& deck_;
  const Value& document_;
  Problems& problems_;
};

}  // namespace

void check_coupling(const Deck& deck, const Value& document, Problems& problems) {
  Checker(deck, document, problems).run();
}

std::vector<DrainedFace> drained_faces(const Deck& deck, const DrainageSpec& drainage,
                                       const SampledBody& body) {
  std::unique_ptr<const Shape> region;
  SurfaceSelection selection;
  if (drainage.region) region = make_shape(*drainage.region, deck.domain.dimension);
  selection.region = region.get();
  selection.facing = drainage.facing;
  for (int a = 0; a < deck.domain.dimension && !drainage.walls; ++a) {
    for (int side = 0; side < 2; ++side) {
      selection.wall[std::size_t(a)][std::size_t(side)] =
          deck.boundary.face(a, side).type != FaceType::open;
    }
  }
  selection.domain_upper = deck.domain.upper;
  std::vector<std::unique_ptr<const Shape>> others;
  for (const BodySpec& other : deck.bodies) {
    if (other.name != drainage.body)
      others.push_back(make_shape(other.shape, deck.domain.dimension));
  }
  std::vector<DrainedFace> faces;
  const double area = std::pow(body.spacing, deck.domain.dimension - 1);
  for (const SurfaceFace& face : single_faces(body, selection)) {
    DrainedFace drained;
    drained.particle = face.particle;
    drained.area[std::size_t(face.axis)] = face.sign * area;
    drained.offset[std::size_t(face.axis)] = 0.5 * face.sign * body.spacing;
    std::array<double, 3> beyond{};
    for (std::size_t a = 0; a < 3; ++a) {
      beyond[a] = body.position[3 * std::size_t(face.particle) + a] + 1.5 * drained.offset[a];
    }
    const bool covered = std::any_of(others.begin(), others.end(), [&](const auto& other) {
      return other->signed_distance(beyond.data()) <= 0;
    });
    if (!covered) faces.push_back(drained);
  }
  return faces;
}

}  // namespace scree

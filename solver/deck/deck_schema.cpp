// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "materials/registry.hpp"
#include "solver/deck/deck.hpp"

/// The schema of a whole deck: mostly the schemas of its tables, which live beside their users.
namespace scree {
namespace {

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const MaterialEntry& model : material_registry()) names.push_back(model.name);
  return names;
}

/// Models that other versions or builds of scree know.
std::vector<std::string> absent_models() {
  std::vector<std::string> names{
      "fixed_corotated", "hencky",       "neo_hookean", "von_mises",
      "drucker_prager",  "mohr_coulomb", "nacc",        "modified_cam_clay",
      "j_fluid",         "newtonian",    "mu_i"};
  const auto present = model_names();
  std::erase_if(names, [&](const std::string& name) {
    return std::find(present.begin(), present.end(), name) != present.end();
  });
  return names;
}

std::vector<std::string> effective_stress_models() {
  std::vector<std::string> names;
  for (const MaterialEntry& model : material_registry()) {
    if (model.effective_stress) names.push_back(model.name);
  }
  return names;
}

Schema<MaterialSpec> make_material_schema() {
  Schema<MaterialSpec> s("material",
                         "What a body is made of: a model, the density, and the keys "
                         "of the model.");
  s.text("model", &MaterialSpec::model)
      .one_of(model_names())
      .later(absent_models())
      .doc("Constitutive model.");
  s.number("density", &MaterialSpec::density, Unit::density)
      .above(0)
      .doc("Mass per volume at the start.");
  s.number("undrained_bulk_modulus", &MaterialSpec::undrained_bulk_modulus, Unit::pressure)
      .above(0)
      .when("model", effective_stress_models())
      .fallback_text("no pore water")
      .doc(
          "Pore water that cannot drain: its bulk modulus over the porosity, K_f/n. The model's "
          "stress is then the effective one, `stress` and `pressure` are total, and there are the "
          "fields `pore_pressure` (excess, compression positive) and `effective_stress`. "
          "Skempton's B is K/(K + K_model).");
  return s;
}

/// The table with only (or without) the keys of `schema`.
Value part_of(const Value& table, const SchemaBase& schema, bool only) {
  Value part = table;
  std::erase_if(part.items,
                [&](const Value& item) { return (schema.find(item.key) != nullptr) != only; });
  return part;
}

void check_density(const MaterialSpec& spec, const MaterialEntry& model, const Value& table,
                   const std::string& path, SchemaReader& reader) {
  if (!model.density_fault) return;
  const auto fault = model.density_fault(spec.input, spec.density);
  const Value* density = table.find("density");
  if (!fault || !density) return;
  reader.report(*density, path + "." + fault->key, fault->message, fault->allowed, fault->repair);
}

void read_material(MaterialSpec& spec, const Value& value, const std::string& path,
                   SchemaReader& reader) {
  if (!value.is(Value::Kind::table)) {
    reader.read(material_schema(), &spec, value, path);
    return;
  }
  const bool common_right =
      reader.read(material_schema(), &spec, part_of(value, material_schema(), true), path);
  const MaterialEntry* model = find_material_model(spec.model);
  if (model == nullptr) return;
  spec.input = model->make_input();
  std::vector<std::string> common = material_schema().keys();
  if (!model->effective_stress) std::erase(common, "undrained_bulk_modulus");
  const bool own_right = reader.read(*model->schema, model->input_pointer(spec.input),
                                     part_of(value, material_schema(), false), path, common);
  if (common_right && own_right) check_density(spec, *model, value, path, reader);
}

/// The schema of a deck's top level, with the one entry that no field function makes: materials,
/// whose keys depend on their model.
class DeckSchema : public Schema<Deck> {
 public:
  DeckSchema()
      : Schema<Deck>("deck",
                     "An input deck: a TOML file. Numbers are SI; a quoted number may carry "
                     "a unit.") {}

  Field<std::vector<MaterialSpec>> materials() {
    using Materials = std::vector<MaterialSpec>;
    Entry& e = bind("material", EntryKind::named, Unit::none, &Deck::materials);
    e.tag = "";
    e.nested = []() -> const SchemaBase& { return material_schema(); };
    e.variants = [] {
      std::vector<const SchemaBase*> result;
      for (const MaterialEntry& model : material_registry()) result.push_back(model.schema);
      return result;
    };
    e.read = [](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
      for (const Value* item : reader.named_tables(value, path)) {
        MaterialSpec& spec = static_cast<Materials*>(m)->emplace_back();
        spec.name = item->key;
        read_material(spec, *item, path + "." + toml_key(item->key), reader);
      }
    };
    e.write = [](const void*, int) { return std::string(); };
    e.visit = [](const void* m, const Entry::Visitor& visitor) {
      for (const MaterialSpec& spec : *static_cast<const Materials*>(m)) {
        visitor(spec.name, material_schema(), &spec);
        const MaterialEntry* model = find_material_model(spec.model);
        if (model == nullptr) continue;
        std::any input = spec.input;
        visitor(spec.name, *model->schema, model->input_pointer(input));
      }
    };
    return Field<Materials>(e);
  }
};

DeckSchema make_deck_schema() {
  DeckSchema s;
  s.text("title", &Deck::title).fallback("").doc("Shown in pictures and summaries.");
  s.table("domain", &Deck::domain, &domain_schema).doc("The box that holds the grid.");
  s.table("time", &Deck::time, &time_schema).doc("Simulated time and steps.");
  s.table("method", &Deck::method, &method_schema).fallback_text("all defaults").doc("Method.");
  s.materials().doc("Materials, at least one.");
  s.named("body", &Deck::bodies, &body_schema).doc("Bodies, at least one.");
  s.named("traction", &Deck::tractions, &traction_schema).fallback_text("none").doc("Loads.");
  s.table("boundary", &Deck::boundary, &boundary_schema)
      .fallback_text("all open")
      .doc("Faces of the domain.");
  s.named("collider", &Deck::colliders, &collider_schema)
      .fallback_text("none")
      .doc("Rigid obstacles and tools.");
  s.table("output", &Deck::output, &output_schema).fallback_text("all defaults").doc("Frames.");
  s.named("frames", &Deck::frames, &frames_schema)
      .fallback_text("none")
      .doc("Further series of frames.");
  s.table("history", &Deck::history, &history_schema)
      .fallback_text("all defaults")
      .doc("Table of sums.");
  s.named("probe", &Deck::probes, &probe_schema)
      .fallback_text("none")
      .doc("Tables of places and particles over time.");
  s.named("profile", &Deck::profiles, &profile_schema)
      .fallback_text("none")
      .doc("Tables of means along lines over time.");
  s.named("section", &Deck::sections, &section_schema)
      .fallback_text("none")
      .doc("Tables of means in planes over time.");
  s.table("checkpoint", &Deck::checkpoint, &checkpoint_schema)
      .fallback_text("all defaults")
      .doc("States to resume from.");
  return s;
}

}  // namespace

const Schema<MaterialSpec>& material_schema() {
  static const Schema<MaterialSpec> schema = make_material_schema();
  return schema;
}

const Schema<Deck>& deck_schema() {
  static const DeckSchema schema = make_deck_schema();
  return schema;
}

}  // namespace scree

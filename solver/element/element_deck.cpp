// SPDX-License-Identifier: Apache-2.0
#include "solver/element/element_deck.hpp"

#include <filesystem>

#include "solver/deck/document.hpp"
#include "solver/deck/expression.hpp"
#include "solver/deck/pore_keys.hpp"
#include "solver/deck/quiet_floats.hpp"

namespace scree {
namespace {

/// Materials are read as in a deck of a run: the entry is that deck's, on this spec's member.
class ElementSchema : public Schema<ElementDeck> {
 public:
  ElementSchema()
      : Schema<ElementDeck>("element",
                            "A deck of `scree element`: a material point driven along a path. It "
                            "has title, one material as in any deck, and the path.") {}

  Field<std::vector<MaterialSpec>> materials() {
    Entry& e = bind("material", EntryKind::named, Unit::none, &ElementDeck::materials);
    const auto member = e.member;
    e = *deck_schema().find("material");
    e.member = member;
    return Field<std::vector<MaterialSpec>>(e);
  }
};

ElementSchema make_element_schema() {
  ElementSchema s;
  s.text("title", &ElementDeck::title).fallback("").doc("Shown in the picture.");
  s.materials().doc("The material, exactly one.");
  s.table("path", &ElementDeck::driven, &path_schema).doc("How the point is driven.");
  return s;
}

void check_material_count(const ElementDeck& deck, const Value& document, Problems& problems) {
  if (deck.materials.size() == 1 || problems.any_under("material")) return;
  const Value* table = document.find("material");
  Problem problem;
  problem.key = "material";
  problem.where = table ? table->position : document.position;
  problem.message = deck.materials.empty()
                        ? "has no material"
                        : "has " + std::to_string(deck.materials.size()) + " materials";
  problem.allowed = "exactly one";
  problem.repair = deck.materials.empty() ? "add [material.NAME]" : "remove the others";
  if (table && deck.materials.size() > 1) problem.where = table->items[1].position;
  problems.add(problem);
}

/// Water that cannot leave the pores contradicts a drained test.
void check_water(const ElementDeck& deck, const Value& document, Problems& problems) {
  if (deck.driven.type != LabTest::triaxial_drained || problems.any_under("path.type")) return;
  const Value* table = document.find("material");
  if (!table || deck.materials.size() != 1) return;
  const Value* water = table->items.front().find("undrained_bulk_modulus");
  if (!water) return;
  Problem problem;
  problem.key = "material." + deck.materials.front().name + ".undrained_bulk_modulus";
  problem.where = water->position;
  problem.value = to_toml(*water);
  problem.message = "keeps the water in the pores, but path.type = \"triaxial_drained\" drains it";
  problem.repair = "remove it, or set path.type to triaxial_undrained";
  problems.add(problem);
}

/// A point has no surface through which water could flow.
void check_pores(const ElementDeck& deck, const Value& document, Problems& problems) {
  const Value* table = document.find("material");
  if (!table || deck.materials.size() != 1) return;
  for (const std::string& name : pore_key_names()) {
    const Value* value = table->items.front().find(name);
    if (!value) continue;
    Problem problem;
    problem.key = "material." + deck.materials.front().name + "." + name;
    if (problems.any_under(problem.key)) continue;
    problem.where = value->position;
    problem.value = to_toml(*value);
    problem.message = "belongs to water that flows, which a single point does not have";
    problem.repair = "remove it; for water that stays set undrained_bulk_modulus";
    problems.add(problem);
  }
}

ElementDeck interpret(std::optional<Value> document, const std::vector<std::string>& overrides,
                      Problems& problems) {
  ElementDeck deck;
  if (!document) return deck;
  const QuietFloats quiet;
  for (const std::string& assignment : overrides) apply_override(*document, assignment, problems);
  SchemaContext context;
  context.formula_fault = &Expression::fault;
  SchemaReader reader(context, problems);
  reader.read(element_schema(), &deck, *document, "");
  check_material_count(deck, *document, problems);
  check_water(deck, *document, problems);
  check_pores(deck, *document, problems);
  return deck;
}

void set_name(ElementDeck& deck, const std::string& path) {
  deck.path = path;
  deck.name = std::filesystem::path(path).stem().string();
}

}  // namespace

const Schema<ElementDeck>& element_schema() {
  static const ElementSchema schema = make_element_schema();
  return schema;
}

ElementDeck read_element_deck(const std::string& path, const std::vector<std::string>& overrides,
                              Problems& problems) {
  ElementDeck deck = interpret(read_document(path, problems), overrides, problems);
  set_name(deck, path);
  return deck;
}

ElementDeck read_element_text(const std::string& text, const std::string& source,
                              const std::vector<std::string>& overrides, Problems& problems) {
  ElementDeck deck = interpret(parse_document(text, source, problems), overrides, problems);
  set_name(deck, source);
  return deck;
}

ElementDeck read_element_document(Value document, const std::string& source, Problems& problems) {
  ElementDeck deck = interpret(std::move(document), {}, problems);
  set_name(deck, source);
  return deck;
}

}  // namespace scree

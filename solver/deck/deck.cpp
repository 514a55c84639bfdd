// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/deck.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "materials/registry.hpp"
#include "solver/deck/deck_checks.hpp"
#include "solver/deck/document.hpp"
#include "solver/deck/expression.hpp"
#include "solver/deck/file_paths.hpp"
#include "solver/deck/new_tables.hpp"
#include "solver/deck/quiet_floats.hpp"

namespace scree {
namespace {

/// What other tables need before they can be read: the dimension and the kernel.
SchemaContext context_of(const Value& document) {
  SchemaContext context;
  context.formula_fault = &Expression::fault;
  const Value* domain = document.find("domain");
  const Value* dimension = domain ? domain->find("dimension") : nullptr;
  context.dimension = 0;
  for (const int possible : {2, 3}) {
    const bool integer = dimension && dimension->is(Value::Kind::integer);
    if (integer && dimension->integer == possible) context.dimension = possible;
  }
  const Value* method = document.find("method");
  const Value* kernel = method ? method->find("kernel") : nullptr;
  if (kernel && kernel->is(Value::Kind::text)) context.kernel = kernel->text;
  return context;
}

/// Defaults that are values of other tables, and what follows from the input.
void complete(Deck& deck) {
  if (std::isnan(deck.output.every)) deck.output.every = deck.time.end;
  if (std::isnan(deck.history.every)) deck.history.every = deck.output.every;
  const auto set = [](double& value, double fallback) {
    if (std::isnan(value)) value = fallback;
  };
  for (OutputSpec& frames : deck.frames) set(frames.every, deck.output.every);
  for (ProbeSpec& probe : deck.probes) {
    set(probe.every, deck.history.every);
    set(probe.radius, deck.domain.cell_size);
  }
  for (ProfileSpec& profile : deck.profiles) {
    set(profile.every, deck.history.every);
    set(profile.radius, deck.domain.cell_size);
  }
  for (SectionSpec& section : deck.sections) {
    set(section.every, deck.history.every);
    set(section.spacing, deck.domain.cell_size);
    set(section.thickness, section.spacing);
  }
  deck.domain.cells = {1, 1, 1};
  for (int axis = 0; axis < deck.domain.dimension; ++axis) {
    deck.domain.cells[static_cast<std::size_t>(axis)] =
        static_cast<int>(cell_count(deck.domain, axis));
  }
}

Deck interpret(std::optional<Value> document, const std::string& path,
               const std::vector<std::string>& overrides, Problems& problems) {
  Deck deck;
  if (!document) return deck;
  const QuietFloats quiet;
  const Value original = *document;
  for (const std::string& assignment : overrides) apply_override(*document, assignment, problems);
  resolve_file_paths(*document, path);
  refuse_incomplete_tables(*document, original, deck_schema(), problems);
  SchemaReader reader(context_of(*document), problems);
  reader.read(deck_schema(), &deck, *document, "");
  deck.given = reader.given();
  check_deck(deck, *document, problems);
  if (problems.empty()) complete(deck);
  return deck;
}

}  // namespace

const MaterialSpec* Deck::find_material(const std::string& material) const {
  for (const MaterialSpec& spec : materials) {
    if (spec.name == material) return &spec;
  }
  return nullptr;
}

bool Deck::wants_field(const std::string& field) const {
  const auto has = [&](const std::vector<std::string>& fields) {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
  };
  const auto any = [&](const auto& specs) {
    return std::any_of(specs.begin(), specs.end(), [&](const auto& s) { return has(s.fields); });
  };
  const bool framed = output.format != FrameFormat::none && has(output.fields);
  return framed || any(frames) || any(probes) || any(profiles) || any(sections);
}

Deck read_deck(const std::string& path, const std::vector<std::string>& overrides,
               Problems& problems) {
  Deck deck = interpret(read_document(path, problems), path, overrides, problems);
  deck.path = path;
  deck.name = std::filesystem::path(path).stem().string();
  return deck;
}

Deck read_deck_text(const std::string& text, const std::string& source,
                    const std::vector<std::string>& overrides, Problems& problems) {
  Deck deck = interpret(parse_document(text, source, problems), source, overrides, problems);
  deck.path = source;
  deck.name = std::filesystem::path(source).stem().string();
  return deck;
}

Deck read_deck_document(Value document, const std::string& source, Problems& problems) {
  Deck deck = interpret(std::move(document), source, {}, problems);
  deck.path = source;
  deck.name = std::filesystem::path(source).stem().string();
  return deck;
}

std::vector<std::string> citations(const Deck& deck) {
  std::vector<std::string> result;
  const auto add = [&](const std::string& publication) {
    for (const std::string& known : result) {
      if (known == publication) return;
    }
    result.push_back(publication);
  };
  if (deck.method.kernel == KernelType::compact) {
    for (const std::string& publication : method_schema().citations()) add(publication);
  }
  if (deck.method.volumetric_locking == VolumetricLocking::fbar) {
    add("Y. Zhao, C. Jiang, J. Choo, Circumventing volumetric locking in explicit material point "
        "methods, Int. J. Numer. Methods Engrg. 124, 2023, doi 10.1002/nme.7347");
  }
  for (const MaterialSpec& material : deck.materials) {
    const MaterialEntry* model = find_material_model(material.model);
    if (model == nullptr) continue;
    for (const std::string& publication : model->schema->citations()) add(publication);
  }
  return result;
}

}  // namespace scree

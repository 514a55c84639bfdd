// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "materials/material.hpp"
#include "solver/base/schema.hpp"

/// The deck's reference, made from the schemas: what `scree describe` prints.
namespace scree {

/// One schema, with all the places of a deck where it is used.
struct ReferenceSection {
  const SchemaBase* schema = nullptr;
  std::vector<std::string> places;  ///< "[domain]", "[body.NAME] shape"
  bool model = false;               ///< a material's model
};

/// All schemas of a deck, outermost first.
class Reference {
 public:
  Reference();

  const std::vector<ReferenceSection>& sections() const { return sections_; }
  /// The sections of a topic: the name of a schema, of a top-level table, or of a key. Empty when
  /// there is none.
  std::vector<const ReferenceSection*> find(const std::string& topic) const;
  /// The names of the schemas.
  std::vector<std::string> topics() const;
  /// All that find() knows: the topics and all keys, each once.
  std::vector<std::string> names() const;

 private:
  void collect(const SchemaBase& schema, const std::string& place, bool model);
  void collect_nested(const SchemaBase& schema, const std::string& place);

  std::vector<ReferenceSection> sections_;
};

/// The keys of [material.NAME] that a model has besides its own, "model" apart; none for other
/// schemas.
std::vector<Entry> shared_entries(const ReferenceSection& section);

/// The output fields that a model adds, or those that all particles have, of [output]; none for
/// other schemas.
std::vector<StateField> output_fields(const ReferenceSection& section);

/// What a value is: "number [Pa], above 0 Pa", "d numbers [m]", "compact, quadratic, linear".
std::string value_form(const Entry& entry);
/// "required", or the default.
std::string default_form(const Entry& entry);
/// When the key is available: "type = box", "3D"; empty: always.
std::string condition_form(const Entry& entry);

std::string reference_text(const Reference& reference, const std::string& topic);
std::string reference_markdown(const Reference& reference, const std::string& topic);
/// JSON schema, draft 2020-12, of a deck (as the JSON of its TOML).
std::string reference_json_schema(const Reference& reference);

}  // namespace scree

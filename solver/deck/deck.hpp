// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/schema.hpp"
#include "solver/boundary/collider_spec.hpp"
#include "solver/boundary/face_spec.hpp"
#include "solver/boundary/traction_spec.hpp"
#include "solver/io/output_spec.hpp"
#include "solver/io/sample_spec.hpp"
#include "solver/particles/body_spec.hpp"
#include "solver/simulation/domain_spec.hpp"
#include "solver/simulation/method_spec.hpp"
#include "solver/simulation/time_spec.hpp"

namespace scree {

/// `[material.NAME]`
struct MaterialSpec {
  std::string name;
  std::string model;                                          ///< a name of the material registry
  double density = std::numeric_limits<double>::quiet_NaN();  ///< kg/m^3
  std::optional<double> undrained_bulk_modulus;               ///< of the pore water, Pa
  std::any input;                                             ///< the model's Input
};

/// A checked deck: all values in SI, all defaults filled in.
struct Deck {
  std::string path;  ///< of the file
  std::string name;  ///< the file's name without .toml; names the run folder
  std::string title;
  DomainSpec domain;
  TimeSpec time;
  MethodSpec method;
  std::vector<MaterialSpec> materials;  ///< these vectors in the deck's order
  std::vector<BodySpec> bodies;
  std::vector<TractionSpec> tractions;
  BoundarySpec boundary;
  std::vector<ColliderSpec> colliders;
  OutputSpec output;
  std::vector<OutputSpec> frames;  ///< further series
  HistorySpec history;
  std::vector<ProbeSpec> probes;
  std::vector<ProfileSpec> profiles;
  std::vector<SectionSpec> sections;
  CheckpointSpec checkpoint;
  std::set<std::string> given;  ///< dotted paths of the keys the user wrote

  /// The material of that name, or nullptr.
  const MaterialSpec* find_material(const std::string& name) const;
  /// Whether frames or tables hold this particle field.
  bool wants_field(const std::string& name) const;
};

/// Reads a deck and checks everything that can be known without running it. `overrides` are
/// KEY=VALUE of --set. Mistakes go to `problems`; when there are any, the deck must not be used.
Deck read_deck(const std::string& path, const std::vector<std::string>& overrides,
               Problems& problems);

/// The same for a deck in memory; `source` names it in messages.
Deck read_deck_text(const std::string& text, const std::string& source,
                    const std::vector<std::string>& overrides, Problems& problems);

/// The keys of a whole deck.
const Schema<Deck>& deck_schema();

/// `model` and `density`, which every material has besides the keys of its model.
const Schema<MaterialSpec>& material_schema();

/// Every value used as a deck that reads back to the same; defaults carry the comment `# default`.
std::string resolved_toml(const Deck& deck);

/// The publications to cite for the methods and materials that the deck uses.
std::vector<std::string> citations(const Deck& deck);

}  // namespace scree

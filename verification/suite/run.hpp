// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/deck/deck.hpp"
#include "solver/element/element_deck.hpp"
#include "solver/element/element_test.hpp"
#include "solver/io/snapshot.hpp"
#include "verification/suite/parameters.hpp"

namespace scree {
class DeviceToolkit;
}

namespace scree::verify {

/// One field of a frame.
class Column {
 public:
  explicit Column(const SnapshotField& field) : field_(&field) {}
  double operator()(std::size_t particle, int component = 0) const {
    return field_->values[particle * static_cast<std::size_t>(field_->components) +
                          static_cast<std::size_t>(component)];
  }
  /// Component (i, j) of a tensor.
  double operator()(std::size_t particle, int i, int j) const {
    return (*this)(particle, 3 * i + j);
  }

 private:
  const SnapshotField* field_;
};

/// The particles at one time of a run, in the order of their ids, with the places that they had at
/// t = 0.
class ParticleFrame {
 public:
  ParticleFrame(const ParticleSnapshot& now, const ParticleSnapshot& first);

  double time() const { return now_->time; }
  std::size_t size() const { return now_->id.size(); }
  const Vec3<double>& x(std::size_t particle) const { return x_[particle]; }  ///< m, now
  const Vec3<double>& X(std::size_t particle) const { return X_[particle]; }  ///< m, at t = 0
  int body(std::size_t particle) const { return now_->body[particle]; }
  std::int64_t id(std::size_t particle) const { return now_->id[particle]; }
  /// A field that the deck lists in output.fields; throws std::logic_error for others.
  Column field(const std::string& name) const;

 private:
  const ParticleSnapshot* now_;
  std::vector<Vec3<double>> x_, X_;
};

/// All that one run of a case gave.
struct Run {
  Parameters parameters;
  std::string label;
  double value = 0;  ///< of the swept parameter
  double size = 0;   ///< what errors shrink with

  // A deck of particles.
  Deck deck;
  std::vector<HistoryRow> history;        ///< every history.every, from t = 0 to the end
  std::vector<ParticleSnapshot> frames;   ///< every output.every, from t = 0 to the end
  std::int64_t particles = 0, steps = 0;  ///< particles at t = 0

  // An element deck ([path]).
  std::optional<ElementDeck> element_deck;
  std::optional<ElementResult> element;

  std::string fault;   ///< why it ended early; empty: it did not
  double seconds = 0;  ///< of this core

  double number(const std::string& name) const { return parameters.number(name); }
  const std::string& text(const std::string& name) const { return parameters.text(name); }
  /// A frame by number, the last one for -1.
  ParticleFrame frame(int index = -1) const;
};

/// Runs a deck in this thread: an ordinary one, or an element deck. `document` has no braces left.
/// device: where particles are computed, null: on the processor.
/// A RunFault ends the run early and becomes `fault`. Mistakes of the deck go to `problems`.
/// `stop` is asked between steps; when it says yes, the run ends with a fault.
void execute(Run& run, const Value& document, const std::string& source,
             const std::shared_ptr<const DeviceToolkit>& device, Problems& problems,
             const std::function<bool()>& stop);

}  // namespace scree::verify

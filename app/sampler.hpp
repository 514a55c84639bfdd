// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/deck/deck.hpp"
#include "solver/io/snapshot.hpp"
#include "solver/io/state_archive.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// A recorder of samples: which particles it looks at, and the lines of its table.
class Sampler {
 public:
  /// `file` is relative to the run folder; `places` are the columns that say where a row is.
  Sampler(std::string file, const SampleSpec& spec, std::vector<std::string> places);
  virtual ~Sampler() = default;

  const std::string& file() const { return file_; }
  /// The fields that its snapshots must hold.
  const std::vector<std::string>& fields() const { return fields_; }
  /// The particles that its snapshots must hold.
  virtual ParticleFilter filter() const = 0;

  /// Called once, at t = 0.
  virtual void begin(const Simulation&) {}
  /// What begin() found, for continued runs.
  virtual void save(StateWriter&) const {}
  virtual void load(const StateReader&) {}

  /// The header of the table, as the fields of a snapshot have it.
  std::string header(const ParticleSnapshot& snapshot) const;
  /// The rows of one time, each with its end.
  virtual std::string lines(const ParticleSnapshot& snapshot) const = 0;

 protected:
  /// How many of the snapshot's fields are shown; the volume may follow.
  std::size_t shown(const ParticleSnapshot& snapshot) const {
    return snapshot.fields.size() - (volume_added_ ? 1 : 0);
  }

 private:
  std::string file_;
  std::vector<std::string> places_, fields_;
  bool volume_added_ = false;
};

/// Throws UserError where a probe follows a particle that is not one of 0 to `particles` - 1.
void check_probes(const Deck& deck, std::int64_t particles);

/// Of a point: the mean of the particles around it; of a particle: its values.
std::unique_ptr<Sampler> make_sampler(const ProbeSpec& spec, const DomainSpec& domain);
std::unique_ptr<Sampler> make_sampler(const ProfileSpec& spec, const DomainSpec& domain);
std::unique_ptr<Sampler> make_sampler(const SectionSpec& spec, const DomainSpec& domain);

/// The particles of a series of frames; empty for all.
ParticleFilter frame_filter(const OutputSpec& spec, int dimension);

}  // namespace scree

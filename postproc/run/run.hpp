// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "postproc/run/frame_source.hpp"
#include "solver/base/value.hpp"

namespace scree {

/// A direction along an axis: 0 x, 1 y, 2 z.
struct Direction {
  int axis = 1;
  int sign = 1;
};

/// A body of the run's deck, as far as files tell.
struct RunBody {
  std::string name;
  double particle_volume = 0;   ///< m^3 at t = 0; in 2D per metre of thickness
  double particle_spacing = 0;  ///< m at t = 0
};

/// A finished or running run: its folder, what its files say about it, and its frames.
class Run {
 public:
  /// Throws UserError: no folder, no run in it, unreadable files.
  explicit Run(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  std::string title() const;   ///< the deck's, or the folder's name
  std::string status() const;  ///< of run.json, "unknown" without one
  /// The resolved deck; an empty table when the folder has none.
  const Value& deck() const { return deck_; }

  int dimension() const { return dimension_; }
  double cell_size() const { return cell_size_; }                ///< m
  const std::array<double, 3>& lower() const { return lower_; }  ///< of the domain, m
  const std::array<double, 3>& upper() const { return upper_; }
  const std::vector<RunBody>& bodies() const { return bodies_; }  ///< in the deck's order

  /// Against gravity; y in 2D and z in 3D without one.
  Direction up() const { return up_; }
  /// The acceleration of gravity at a time [m/s^2].
  std::array<double, 3> gravity(double time) const;

  const FrameSource& frames() const;
  /// The fields of the first frame, which are those of all.
  const std::vector<FieldInfo>& fields() const;

 private:
  void read_domain();
  void read_bodies();
  void read_gravity();

  std::filesystem::path folder_;
  Value deck_;
  int dimension_ = 3;
  double cell_size_ = 0;
  std::array<double, 3> lower_{}, upper_{};
  std::vector<RunBody> bodies_;
  std::array<std::string, 3> gravity_{"0", "0", "0"};
  Direction up_;
  mutable std::unique_ptr<FrameSource> frames_;
  mutable std::optional<std::vector<FieldInfo>> fields_;
};

/// The volume of each particle [m^3; in 2D per metre]: the field `volume` where the snapshot has
/// it, else the initial volume of its body.
std::vector<double> particle_volumes(const Run& run, const ParticleSnapshot& snapshot);

/// A frame and the volume of each of its particles.
struct WeightedFrame {
  ParticleSnapshot particles;
  std::vector<double> volume;  ///< m^3; in 2D per metre
  std::size_t count() const { return volume.size(); }
  const double* place(std::size_t p) const { return &particles.position[3 * p]; }
};

/// Reads a frame with these fields. Throws UserError.
WeightedFrame read_weighted(const Run& run, std::size_t frame, std::vector<std::string> fields);

/// history.csv: a column of numbers a name.
struct History {
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  std::size_t rows() const { return names.empty() ? 0 : columns.at(names.front()).size(); }
  bool has(const std::string& name) const { return columns.count(name) > 0; }
  const std::vector<double>& at(const std::string& name) const { return columns.at(name); }
};

/// Reads the complete rows of history.csv. Throws UserError.
History read_history(const std::filesystem::path& folder);

}  // namespace scree

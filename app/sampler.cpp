// SPDX-License-Identifier: Apache-2.0
#include "app/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "solver/base/error.hpp"
#include "solver/particles/shape.hpp"

namespace scree {
namespace {

using Point = std::array<double, 3>;

double squared(double x) { return x * x; }

double distance(const double* x, const Point& y) {
  return std::sqrt(squared(x[0] - y[0]) + squared(x[1] - y[1]) + squared(x[2] - y[2]));
}

/// The names of a field's columns.
std::vector<std::string> field_columns(const SnapshotField& field) {
  static const std::vector<std::string> vector{"x", "y", "z"},
      tensor{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  if (field.components == 1) return {field.name};
  std::vector<std::string> columns;
  for (int c = 0; c < field.components; ++c) {
    const std::size_t k = static_cast<std::size_t>(c);
    std::string end = std::to_string(c + 1);
    if (field.components == 3 && field.name != "principal_stress") end = vector[k];
    if (field.components == 9) end = tensor[k];
    columns.push_back(field.name + "_" + end);
  }
  return columns;
}

/// Weighted means over bins.
class BinSampler : public Sampler {
 public:
  using Sampler::Sampler;

  std::string lines(const ParticleSnapshot& snapshot) const override {
    const std::size_t fields = shown(snapshot);
    const std::vector<double>& volume = volumes(snapshot);
    std::map<std::int64_t, Sums> bins;
    if (single()) bins[0].resize(snapshot, fields);
    for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
      const Place place = place_of(&snapshot.position[3 * p]);
      if (place.bin < 0) continue;
      Sums& sums = bins[place.bin];
      if (sums.values.empty()) sums.resize(snapshot, fields);
      sums.add(snapshot, fields, p, place.weight * volume[p]);
    }
    std::string text;
    for (const auto& [bin, sums] : bins) {
      fmt::format_to(std::back_inserter(text), "{},{}", snapshot.step, snapshot.time);
      for (const double x : bin_place(bin)) fmt::format_to(std::back_inserter(text), ",{}", x);
      fmt::format_to(std::back_inserter(text), ",{}", sums.count);
      for (const double sum : sums.values) {
        fmt::format_to(
            std::back_inserter(text), ",{}",
            sums.count > 0 ? sum / sums.weight : std::numeric_limits<double>::quiet_NaN());
      }
      text += '\n';
    }
    return text;
  }

 protected:
  struct Place {
    std::int64_t bin;  ///< -1: none
    double weight;
  };
  virtual Place place_of(const double* x) const = 0;
  virtual std::vector<double> bin_place(std::int64_t bin) const = 0;
  /// One bin that has a row even without particles.
  virtual bool single() const { return false; }

  ParticleFilter filter() const override {
    return [this](std::int64_t, const double* x) { return place_of(x).bin >= 0; };
  }

 private:
  struct Sums {
    double weight = 0;
    std::int64_t count = 0;
    std::vector<double> values;

    void resize(const ParticleSnapshot& snapshot, std::size_t fields) {
      std::size_t size = 0;
      for (std::size_t f = 0; f < fields; ++f) size += std::size_t(snapshot.fields[f].components);
      values.assign(size, 0.0);
    }
    void add(const ParticleSnapshot& snapshot, std::size_t fields, std::size_t p, double share) {
      weight += share;
      ++count;
      std::size_t at = 0;
      for (std::size_t f = 0; f < fields; ++f) {
        const std::size_t components = std::size_t(snapshot.fields[f].components);
        for (std::size_t c = 0; c < components; ++c) {
          values[at++] += share * snapshot.fields[f].values[p * components + c];
        }
      }
    }
  };

  static const std::vector<double>& volumes(const ParticleSnapshot& snapshot) {
    const auto volume = std::find_if(snapshot.fields.begin(), snapshot.fields.end(),
                                     [](const SnapshotField& f) { return f.name == "volume"; });
    return volume->values;
  }
};

class PointProbe final : public BinSampler {
 public:
  explicit PointProbe(const ProbeSpec& spec)
      : BinSampler("probes/" + spec.name + ".csv", spec, {"particles"}), spec_(spec) {
    for (double& x : spec_.at) x = std::isnan(x) ? 0 : x;
  }

 protected:
  Place place_of(const double* x) const override {
    const double weight = 1 - distance(x, spec_.at) / spec_.radius;
    return {weight > 0 ? 0 : -1, weight};
  }
  std::vector<double> bin_place(std::int64_t) const override { return {}; }
  bool single() const override { return true; }

 private:
  ProbeSpec spec_;
};

class ParticleProbe final : public Sampler {
 public:
  explicit ParticleProbe(const ProbeSpec& spec)
      : Sampler("probes/" + spec.name + ".csv", spec, {"id", "x", "y", "z"}), spec_(spec) {
    if (spec.id) id_ = static_cast<std::int64_t>(*spec.id);
  }

  ParticleFilter filter() const override {
    return [id = id_](std::int64_t particle, const double*) { return particle == id; };
  }

  void begin(const Simulation& simulation) override {
    if (!spec_.id) id_ = nearest(simulation.particles({}));
  }
  void save(StateWriter& writer) const override { writer.put_value(key(), id_); }
  void load(const StateReader& reader) override { id_ = reader.get_value<std::int64_t>(key()); }

  std::string lines(const ParticleSnapshot& snapshot) const override {
    std::string text = fmt::format("{},{},{}", snapshot.step, snapshot.time, id_);
    // Beyond an open face there is nothing to write down.
    const bool gone = snapshot.id.empty();
    const auto add = [&](const double* values, std::size_t count) {
      for (std::size_t c = 0; c < count; ++c) {
        const double value = gone ? std::numeric_limits<double>::quiet_NaN() : values[c];
        fmt::format_to(std::back_inserter(text), ",{}", value);
      }
    };
    add(snapshot.position.data(), 3);
    for (std::size_t f = 0; f < shown(snapshot); ++f) {
      add(snapshot.fields[f].values.data(), std::size_t(snapshot.fields[f].components));
    }
    return text + "\n";
  }

 private:
  std::string key() const { return "run/probe_" + spec_.name; }

  std::int64_t nearest(const ParticleSnapshot& snapshot) const {
    Point at = spec_.at;
    for (double& x : at) x = std::isnan(x) ? 0 : x;
    std::int64_t id = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
      const double d = distance(&snapshot.position[3 * p], at);
      if (d >= least) continue;
      least = d;
      id = snapshot.id[p];
    }
    return id;
  }

  ProbeSpec spec_;
  std::int64_t id_ = -1;
};

class Profile final : public BinSampler {
 public:
  explicit Profile(const ProfileSpec& spec)
      : BinSampler("profiles/" + spec.name + ".csv", spec, {"s", "x", "y", "z", "particles"}),
        spec_(spec),
        length_(distance(spec.to.data(), spec.from)) {
    for (std::size_t a = 0; a < 3; ++a) along_[a] = (spec.to[a] - spec.from[a]) / length_;
  }

 protected:
  Place place_of(const double* x) const override {
    double s = 0, square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      s += (x[a] - spec_.from[a]) * along_[a];
      square += squared(x[a] - spec_.from[a]);
    }
    const bool near = square - s * s < squared(spec_.radius);
    if (!near || s < 0 || s > length_) return {-1, 0};
    const auto bin = static_cast<std::int64_t>(s / length_ * spec_.bins);
    return {std::min<std::int64_t>(bin, spec_.bins - 1), 1};
  }
  std::vector<double> bin_place(std::int64_t bin) const override {
    const double s = (double(bin) + 0.5) / spec_.bins * length_;
    return {s, spec_.from[0] + s * along_[0], spec_.from[1] + s * along_[1],
            spec_.from[2] + s * along_[2]};
  }

 private:
  ProfileSpec spec_;
  double length_;
  Point along_{};
};

class Section final : public BinSampler {
 public:
  Section(const SectionSpec& spec, const DomainSpec& domain)
      : BinSampler("sections/" + spec.name + ".csv", spec, {"x", "y", "z", "particles"}),
        spec_(spec),
        domain_(domain) {
    if (domain.dimension == 3) across_ = static_cast<int>(spec.normal);
    if (spec.region) region_ = make_shape(*spec.region, domain.dimension);
    for (int a = 0; a < 3; ++a) {
      if (a != across_) (first_ < 0 ? first_ : second_) = a;
    }
    const std::size_t k = std::size_t(second_);
    columns_ =
        static_cast<std::int64_t>(std::ceil((domain.upper[k] - domain.lower[k]) / spec.spacing)) +
        1;
  }

 protected:
  Place place_of(const double* x) const override {
    const bool slab = domain_.dimension == 3;
    if (slab && std::abs(x[across_] - spec_.position) > 0.5 * spec_.thickness) return {-1, 0};
    if (region_ && region_->signed_distance(x) > 0) return {-1, 0};
    const std::int64_t i = index(x, first_), j = index(x, second_);
    if (i < 0 || j < 0) return {-1, 0};
    return {i * columns_ + std::min(j, columns_ - 1), 1};
  }
  std::vector<double> bin_place(std::int64_t bin) const override {
    std::vector<double> x{0, 0, 0};
    if (domain_.dimension == 3) x[std::size_t(across_)] = spec_.position;
    x[std::size_t(first_)] = middle(bin / columns_, first_);
    x[std::size_t(second_)] = middle(bin % columns_, second_);
    return x;
  }

 private:
  std::int64_t index(const double* x, int axis) const {
    return static_cast<std::int64_t>(
        std::floor((x[axis] - domain_.lower[std::size_t(axis)]) / spec_.spacing));
  }
  double middle(std::int64_t index, int axis) const {
    return domain_.lower[std::size_t(axis)] + (double(index) + 0.5) * spec_.spacing;
  }

  SectionSpec spec_;
  DomainSpec domain_;
  int across_ = 2, first_ = -1, second_ = -1;  ///< axes
  std::int64_t columns_ = 1;                   ///< bins along the second axis
  std::shared_ptr<const Shape> region_;
};

}  // namespace

Sampler::Sampler(std::string file, const SampleSpec& spec, std::vector<std::string> places)
    : file_(std::move(file)), places_(std::move(places)), fields_(spec.fields) {
  volume_added_ = std::find(fields_.begin(), fields_.end(), "volume") == fields_.end();
  if (volume_added_) fields_.emplace_back("volume");
}

std::string Sampler::header(const ParticleSnapshot& snapshot) const {
  std::string text = "step,time";
  for (const std::string& place : places_) text += "," + place;
  for (std::size_t f = 0; f < shown(snapshot); ++f) {
    for (const std::string& column : field_columns(snapshot.fields[f])) text += "," + column;
  }
  return text;
}

void check_probes(const Deck& deck, std::int64_t particles) {
  for (const ProbeSpec& probe : deck.probes) {
    if (!probe.id || *probe.id < double(particles)) continue;
    throw UserError(fmt::format("probe.{}.id = {}: there is no such particle; allowed: 0 to {}",
                                probe.name, *probe.id, particles - 1));
  }
}

std::unique_ptr<Sampler> make_sampler(const ProbeSpec& spec, const DomainSpec&) {
  if (spec.type == ProbeType::particle) return std::make_unique<ParticleProbe>(spec);
  return std::make_unique<PointProbe>(spec);
}

std::unique_ptr<Sampler> make_sampler(const ProfileSpec& spec, const DomainSpec&) {
  return std::make_unique<Profile>(spec);
}

std::unique_ptr<Sampler> make_sampler(const SectionSpec& spec, const DomainSpec& domain) {
  return std::make_unique<Section>(spec, domain);
}

ParticleFilter frame_filter(const OutputSpec& spec, int dimension) {
  if (!spec.region && spec.every_nth == 1) return {};
  std::shared_ptr<const Shape> region;
  if (spec.region) region = make_shape(*spec.region, dimension);
  return [region, nth = spec.every_nth](std::int64_t id, const double* x) {
    return id % nth == 0 && (!region || region->signed_distance(x) <= 0);
  };
}

}  // namespace scree

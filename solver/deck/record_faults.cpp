// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/record_faults.hpp"

#include <algorithm>
#include <cmath>

#include "solver/base/value.hpp"
#include "solver/deck/key_text.hpp"
#include "solver/deck/particle_faults.hpp"
#include "solver/particles/shape.hpp"

namespace scree {
namespace {

constexpr const char* outside = "lies outside of the domain";

class Finder {
 public:
  Finder(const Deck& deck, const Problems& problems) : deck_(deck), problems_(problems) {}

  std::vector<RecordFault> run() && {
    for (const ProbeSpec& probe : deck_.probes) check(probe);
    for (const ProfileSpec& profile : deck_.profiles) check(profile);
    for (const SectionSpec& section : deck_.sections) check(section);
    check_region({"output", "region"}, deck_.output.region);
    for (const OutputSpec& frames : deck_.frames) {
      check_region({"frames", frames.name, "region"}, frames.region);
    }
    return std::move(faults_);
  }

 private:
  bool faulty(const std::vector<std::string>& path) const {
    return problems_.any_under(key_text(path));
  }

  std::string domain_text() const {
    return point_text(deck_.domain.lower, dimension_) + " to " +
           point_text(deck_.domain.upper, dimension_) + " m";
  }

  void check(const ProbeSpec& probe) {
    const std::vector<std::string> path{"probe", probe.name, "at"};
    if (std::isnan(probe.at[0]) || faulty(path)) return;
    if (!passes_domain(probe.at, probe.at, 0))
      faults_.push_back({path, outside, domain_text(), ""});
  }

  void check(const ProfileSpec& profile) {
    const std::vector<std::string> path{"profile", profile.name};
    if (faulty(path)) return;
    const double radius = std::isnan(profile.radius) ? deck_.domain.cell_size : profile.radius;
    if (passes_domain(profile.from, profile.to, radius)) return;
    faults_.push_back({{"profile", profile.name, "from"},
                       "the line to " + point_text(profile.to, dimension_) + " m " + outside,
                       domain_text(),
                       "move from or to"});
  }

  void check(const SectionSpec& section) {
    const std::vector<std::string> path{"section", section.name};
    if (faulty(path)) return;
    check_region({"section", section.name, "region"}, section.region);
    if (dimension_ != 3) return;
    const auto axis = static_cast<std::size_t>(section.normal);
    const double lower = deck_.domain.lower[axis], upper = deck_.domain.upper[axis];
    if (section.position >= lower && section.position <= upper) return;
    faults_.push_back({{"section", section.name, "position"},
                       outside,
                       toml_number(lower) + " to " + toml_number(upper) + " m",
                       ""});
  }

  void check_region(const std::vector<std::string>& path, const std::optional<ShapeSpec>& region) {
    if (!region || faulty(path)) return;
    const Box box = make_shape(*region, dimension_)->bounds();
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
      const bool meets =
          box.lower[a] <= deck_.domain.upper[a] && box.upper[a] >= deck_.domain.lower[a];
      if (meets) continue;
      faults_.push_back({path, outside, "shapes that meet " + domain_text(), ""});
      return;
    }
  }

  /// True if the line comes nearer to the domain than `reach` (m) in every axis, at one place.
  bool passes_domain(const std::array<double, 3>& from, const std::array<double, 3>& to,
                     double reach) const {
    double enter = 0, leave = 1;  // as shares of the line
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
      const double below = deck_.domain.lower[a] - reach - from[a];
      const double above = deck_.domain.upper[a] + reach - from[a];
      const double way = to[a] - from[a];
      if (way == 0 && (below > 0 || above < 0)) return false;
      if (way == 0) continue;
      enter = std::max(enter, std::min(below / way, above / way));
      leave = std::min(leave, std::max(below / way, above / way));
    }
    return enter <= leave;
  }

  const Deck& deck_;
  const Problems& problems_;
  const int dimension_ = deck_.domain.dimension;
  std::vector<RecordFault> faults_;
};

}  // namespace

std::vector<RecordFault> record_faults(const Deck& deck, const Problems& problems) {
  if (problems.any_under("domain")) return {};
  return Finder(deck, problems).run();
}

}  // namespace scree

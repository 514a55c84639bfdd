// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/history_column.hpp"

#include <array>

namespace scree {
namespace {

struct Known {
  const char* begin;  ///< of the column's name
  const char* title;
  const char* unit;
  bool extensive;  ///< in 2D per metre of thickness
};

constexpr std::array<Known, 17> known_columns = {
    {{"step", "Step", "", false},
     {"time", "Time", "s", false},
     {"dt", "Length of the step", "s", false},
     {"particle_count", "Particles", "", false},
     {"mass", "Mass", "kg", true},
     {"momentum", "Momentum", "kg m/s", true},
     {"angular", "Angular momentum", "kg m²/s", true},
     {"center", "Centre of mass", "m", false},
     {"kinetic", "Energy", "J", true},
     {"elastic", "Energy", "J", true},
     {"max_speed", "Largest speed", "m/s", false},
     {"fluid_mass", "Pore water", "kg", true},
     {"fluid_outflow", "Pore water", "kg", true},
     {"fluid_balance", "Error of the water's balance", "", false},
     {"pressure_iter", "Iterations", "", false},
     {"external_work", "Energy", "J", true},
     {"", "Value", "", false}}};

constexpr std::array<Known, 4> of_colliders = {{{"force", "Force on colliders", "N", true},
                                                {"torque", "Torque on colliders", "N m", true},
                                                {"work", "Energy", "J", true},
                                                {"displacement", "Way of colliders", "m", false}}};

HistoryKind kind_of(const Known& known, int dimension) {
  return {known.title, known.extensive && dimension == 2 ? std::string(known.unit) + "/m"
                                                         : std::string(known.unit)};
}

}  // namespace

HistoryKind history_kind(const std::string& column, const std::vector<std::string>& colliders,
                         int dimension) {
  for (const std::string& collider : colliders) {
    for (const Known& known : of_colliders) {
      if (column.rfind(collider + "_" + known.begin, 0) == 0) return kind_of(known, dimension);
    }
  }
  for (const Known& known : known_columns) {
    if (column.rfind(known.begin, 0) == 0) return kind_of(known, dimension);
  }
  return {};
}

}  // namespace scree

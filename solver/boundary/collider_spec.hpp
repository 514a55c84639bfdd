// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/schema.hpp"
#include "solver/boundary/contact_type.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

/// The deck names of the contact types of a collider.
inline const std::vector<std::pair<std::string, ContactType>>& contact_type_names() {
  static const std::vector<std::pair<std::string, ContactType>> names{
      {"sticky", ContactType::sticky},
      {"slip", ContactType::slip},
      {"separate", ContactType::separate},
      {"friction", ContactType::friction}};
  return names;
}

/// `contact` of a collider: a name, or a table {type, coefficient}.
struct ContactSpec {
  ContactType type = ContactType::sticky;
  double coefficient = 0;  ///< Coulomb's mu >= 0; required with friction, not allowed otherwise
};

/// `[collider.NAME]`: a rigid body with a prescribed translation.
struct ColliderSpec {
  std::string name;
  ShapeSpec shape;                  ///< any kind, plane included; as it lies at t = 0
  std::array<Formula, 3> velocity;  ///< m/s; expressions of t; not given: at rest
  ContactSpec contact;
};

const Schema<ContactSpec>& contact_schema();
const Schema<ColliderSpec>& collider_schema();

}  // namespace scree

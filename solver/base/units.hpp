// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Physical dimensions of deck values and the reading of quantities such as "10 MPa".
namespace scree {

/// What a number measures; decides its SI unit and which quoted units are accepted.
enum class Unit {
  none,          ///< dimensionless
  length,        ///< m
  time,          ///< s
  mass,          ///< kg
  angle,         ///< rad
  velocity,      ///< m/s
  acceleration,  ///< m/s^2
  rate,          ///< 1/s
  density,       ///< kg/m^3
  pressure,      ///< Pa
  force,         ///< N
  viscosity,     ///< Pa s
  area,          ///< m^2
  volume,        ///< m^3
};

/// Exponents of the base dimensions: length, mass, time, angle.
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

/// The dimension of a unit, e.g. pressure: kg m^-1 s^-2.
Dimension dimension_of(Unit unit);

/// The SI symbol, e.g. "Pa"; empty for a dimensionless number.
std::string unit_symbol(Unit unit);

/// A word for the quantity in messages, e.g. "pressure"; "plain number" for Unit::none.
std::string unit_quantity(Unit unit);

/// Examples of units a user may write, e.g. "Pa, kPa, MPa, GPa".
std::string unit_examples(Unit unit);

/// A number with a unit in SI: "10 MPa" -> value 1e7, dimension of a pressure.
struct Quantity {
  double value = 0;          ///< in SI
  double number = 0;         ///< as written
  Dimension dimension;       ///< of the written unit
  bool has_unit = false;     ///< false for a bare number such as "10"
  std::string unknown_unit;  ///< the part that is no known unit (then value is meaningless)
};

/// Splits `text` into a leading number and a unit made of factors joined by "*", "/", " " with
/// integer powers ("kN/m^3", also "kN/m3" and "kN/m³"; "µ" is u, "°" is deg). Empty when the text
/// does not begin with a complete number followed by something that looks like a unit (so
/// "-9.81*min(t,1)" is no quantity).
std::optional<Quantity> parse_quantity(std::string_view text);

}  // namespace scree

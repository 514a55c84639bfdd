// SPDX-License-Identifier: Apache-2.0
#include "solver/base/units.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

namespace scree {
namespace {

struct UnitInfo {
  Unit unit;
  Dimension dimension;
  const char* symbol;
  const char* quantity;
  const char* examples;
};

// Exponents: length, mass, time, angle.
constexpr UnitInfo unit_table[] = {
    {Unit::none, {0, 0, 0, 0}, "", "plain number", "no unit, or %"},
    {Unit::length, {1, 0, 0, 0}, "m", "length", "m, mm, cm, km"},
    {Unit::time, {0, 0, 1, 0}, "s", "time", "s, ms, us, min, h"},
    {Unit::mass, {0, 1, 0, 0}, "kg", "mass", "kg, g, t"},
    {Unit::angle, {0, 0, 0, 1}, "rad", "angle", "deg, rad"},
    {Unit::velocity, {1, 0, -1, 0}, "m/s", "velocity", "m/s, mm/s, km/h"},
    {Unit::acceleration, {1, 0, -2, 0}, "m/s^2", "acceleration", "m/s^2, cm/s^2"},
    {Unit::rate, {0, 0, -1, 0}, "1/s", "rate", "1/s, Hz"},
    {Unit::density, {-3, 1, 0, 0}, "kg/m^3", "density", "kg/m^3, g/cm^3, t/m^3"},
    {Unit::pressure, {-1, 1, -2, 0}, "Pa", "pressure or stress", "Pa, kPa, MPa, GPa, bar"},
    {Unit::force, {1, 1, -2, 0}, "N", "force", "N, kN, MN"},
    {Unit::viscosity, {-1, 1, -1, 0}, "Pa s", "dynamic viscosity", "Pa s, mPa s"},
    {Unit::area, {2, 0, 0, 0}, "m^2", "area", "m^2, mm^2"},
    {Unit::volume, {3, 0, 0, 0}, "m^3", "volume", "m^3, cm^3"},
};

struct Symbol {
  const char* name;
  double factor;
  Dimension dimension;
};

constexpr Dimension kLength{1, 0, 0, 0}, kMass{0, 1, 0, 0}, kTime{0, 0, 1, 0}, kAngle{0, 0, 0, 1};
constexpr Dimension kPressure{-1, 1, -2, 0}, kForce{1, 1, -2, 0}, kEnergy{2, 1, -2, 0};
constexpr Dimension kRate{0, 0, -1, 0};

constexpr Symbol symbol_table[] = {
    {"m", 1, kLength},
    {"km", 1e3, kLength},
    {"cm", 1e-2, kLength},
    {"dm", 1e-1, kLength},
    {"mm", 1e-3, kLength},
    {"um", 1e-6, kLength},
    {"kg", 1, kMass},
    {"g", 1e-3, kMass},
    {"mg", 1e-6, kMass},
    {"t", 1e3, kMass},
    {"s", 1, kTime},
    {"ms", 1e-3, kTime},
    {"us", 1e-6, kTime},
    {"min", 60, kTime},
    {"h", 3600, kTime},
    {"d", 86400, kTime},
    {"Hz", 1, kRate},
    {"kHz", 1e3, kRate},
    {"rad", 1, kAngle},
    {"mrad", 1e-3, kAngle},
    {"deg", std::numbers::pi / 180, kAngle},
    {"N", 1, kForce},
    {"kN", 1e3, kForce},
    {"MN", 1e6, kForce},
    {"mN", 1e-3, kForce},
    {"Pa", 1, kPressure},
    {"hPa", 1e2, kPressure},
    {"kPa", 1e3, kPressure},
    {"MPa", 1e6, kPressure},
    {"GPa", 1e9, kPressure},
    {"mPa", 1e-3, kPressure},
    {"bar", 1e5, kPressure},
    {"mbar", 1e2, kPressure},
    {"J", 1, kEnergy},
    {"kJ", 1e3, kEnergy},
    {"MJ", 1e6, kEnergy},
    {"%", 1e-2, {}},
    {"1", 1, {}},
};

const UnitInfo& info(Unit unit) {
  for (const UnitInfo& entry : unit_table) {
    if (entry.unit == unit) return entry;
  }
  return unit_table[0];
}

bool is_space(char c) { return c == ' ' || c == '\t'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Signs of engineers' writing in the letters of this reader: "m³", "31°", "µm", "−9.81".
std::string plain(std::string_view text) {
  struct Sign {
    std::string_view written, plain;
  };
  constexpr Sign signs[] = {{"\u00b2", "^2"},    {"\u00b3", "^3"}, {"\u00b5", "u"}, {"\u03bc", "u"},
                            {"\u00b0", " deg "}, {"\u00b7", "*"},  {"\u2212", "-"}};
  std::string result;
  while (!text.empty()) {
    std::string_view written = text.substr(0, 1), letters = written;
    for (const Sign& sign : signs) {
      if (!text.starts_with(sign.written)) continue;
      written = sign.written;
      letters = sign.plain;
    }
    result += letters;
    text.remove_prefix(written.size());
  }
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads the factors of a unit one by one.
class UnitReader {
 public:
  UnitReader(std::string_view text, Quantity& quantity) : text_(text), quantity_(quantity) {}

  /// False when the text is not of the form of a unit at all.
  bool read() {
    int sign = 1;
    if (!factor(sign)) return false;
    while (!text_.empty()) {
      sign = 1;
      const bool spaced = is_space(text_.front());
      text_ = trim(text_);
      if (text_.front() == '*' || text_.front() == '/') {
        sign = text_.front() == '/' ? -1 : 1;
        text_ = trim(text_.substr(1));
      } else if (!spaced) {
        return false;
      }
      if (!factor(sign)) return false;
    }
    return true;
  }

 private:
  /// One factor: a symbol (or the 1 of "1/s") and an optional integer power: m^3, m3.
  bool factor(int sign) {
    std::size_t length = 0;
    while (length < text_.size() && is_letter(text_[length])) ++length;
    if (length == 0 && !text_.empty() && (text_[0] == '%' || text_[0] == '1')) length = 1;
    if (length == 0) return false;
    const std::string name(text_.substr(0, length));
    text_.remove_prefix(length);
    int power = 1;
    if (!text_.empty() && text_.front() == '^') {
      text_.remove_prefix(1);
      if (!read_power(power)) return false;
    } else if (is_letter(name[0]) && !text_.empty() && is_digit(text_.front())) {
      if (!read_power(power)) return false;
    }
    apply(name, sign * power);
    return true;
  }

  bool read_power(int& power) {
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), power);
    if (error != std::errc()) return false;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return power >= -9 && power <= 9;
  }

  void apply(const std::string& name, int power) {
    for (const Symbol& symbol : symbol_table) {
      if (name != symbol.name) continue;
      // Division by a positive power is exact where multiplication by its reciprocal is not.
      for (int i = 0; i < std::abs(power); ++i) {
        quantity_.value = power > 0 ? scaled(symbol.factor) : quantity_.value / symbol.factor;
      }
      quantity_.dimension.length += power * symbol.dimension.length;
      quantity_.dimension.mass += power * symbol.dimension.mass;
      quantity_.dimension.time += power * symbol.dimension.time;
      quantity_.dimension.angle += power * symbol.dimension.angle;
      return;
    }
    if (quantity_.unknown_unit.empty()) quantity_.unknown_unit = name;
  }

  /// value * factor; small decimal factors divide by their exact reciprocal, so that "5 mm" is
  /// the double 0.005.
  double scaled(double factor) const {
    const double inverse = std::round(1 / factor);
    const bool decimal = factor < 1 && std::abs(inverse * factor - 1) < 1e-14;
    return decimal ? quantity_.value / inverse : quantity_.value * factor;
  }

  std::string_view text_;
  Quantity& quantity_;
};

}  // namespace

Dimension dimension_of(Unit unit) { return info(unit).dimension; }
std::string unit_symbol(Unit unit) { return info(unit).symbol; }
std::string unit_quantity(Unit unit) { return info(unit).quantity; }
std::string unit_examples(Unit unit) { return info(unit).examples; }

std::optional<Quantity> parse_quantity(std::string_view written) {
  const std::string letters = plain(written);
  std::string_view text = trim(letters);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Quantity quantity;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error != std::errc() || !std::isfinite(quantity.number)) return std::nullopt;
  quantity.value = quantity.number;
  const std::string_view unit = trim(text.substr(static_cast<std::size_t>(end - text.data())));
  if (unit.empty()) return quantity;
  quantity.has_unit = true;
  if (!UnitReader(unit, quantity).read()) return std::nullopt;
  return quantity;
}

}  // namespace scree

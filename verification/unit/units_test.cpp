// SPDX-License-Identifier: Apache-2.0
#include "solver/base/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree {
namespace {

struct Conversion {
  const char* text;
  double value;
  Unit unit;
};

class Conversions : public testing::TestWithParam<Conversion> {};

TEST_P(Conversions, GivesTheSiValueAndTheDimension) {
  const auto& [text, value, unit] = GetParam();
  const auto quantity = parse_quantity(text);
  ASSERT_TRUE(quantity) << text;
  EXPECT_EQ(quantity->unknown_unit, "") << text;
  // One rounding for each factor of the unit; at most four factors here.
  EXPECT_NEAR(quantity->value, value, 4 * std::abs(value) * std::numeric_limits<double>::epsilon())
      << text;
  EXPECT_TRUE(quantity->dimension == dimension_of(unit)) << text;
}

constexpr double degree = std::numbers::pi / 180;

INSTANTIATE_TEST_SUITE_P(
    Units, Conversions,
    testing::Values(
        Conversion{"10 MPa", 10 * 1e6, Unit::pressure},
        Conversion{"33 deg", 33 * degree, Unit::angle}, Conversion{"2 mm", 2 / 1e3, Unit::length},
        Conversion{"2mm", 2 / 1e3, Unit::length}, Conversion{"1600 kg/m^3", 1600, Unit::density},
        Conversion{"1.6 g/cm^3", 1.6 * 1e-3 / 1e-6, Unit::density},
        Conversion{"1.6 t/m^3", 1600, Unit::density}, Conversion{"250 ms", 0.25, Unit::time},
        Conversion{"2 min", 120, Unit::time}, Conversion{"1e-5 s", 1e-5, Unit::time},
        Conversion{"-9.81 m/s^2", -9.81, Unit::acceleration},
        Conversion{"-9.81 m s^-2", -9.81, Unit::acceleration},
        Conversion{"36 km/h", 36 * 1e3 / 3600, Unit::velocity},
        Conversion{"1e-3 Pa s", 1e-3, Unit::viscosity},
        Conversion{"1 mPa*s", 1e-3, Unit::viscosity}, Conversion{"5 1/s", 5, Unit::rate},
        Conversion{"5 Hz", 5, Unit::rate}, Conversion{"3 kN", 3000, Unit::force},
        Conversion{"2 bar", 2e5, Unit::pressure}, Conversion{"3 kN/m^2", 3000, Unit::pressure},
        Conversion{"30 %", 0.3, Unit::none}, Conversion{"+7", 7, Unit::none},
        Conversion{" 4 m ", 4, Unit::length}, Conversion{"2 m^2", 2, Unit::area},
        Conversion{"2 cm^3", 2e-6, Unit::volume}));

// As engineers write: powers without ^, raised figures, degree sign, micro, minus sign.
INSTANTIATE_TEST_SUITE_P(Signs, Conversions,
                         testing::Values(Conversion{"1600 kg/m3", 1600, Unit::density},
                                         Conversion{"1.6 t/m\u00b3", 1600, Unit::density},
                                         Conversion{"10 N/mm2", 10 * 1e6, Unit::pressure},
                                         Conversion{"\u22129.81 m/s\u00b2", -9.81,
                                                    Unit::acceleration},
                                         Conversion{"31\u00b0", 31 * degree, Unit::angle},
                                         Conversion{"31 \u00b0", 31 * degree, Unit::angle},
                                         Conversion{"5 \u00b5m", 5 / 1e6, Unit::length},
                                         Conversion{"5 \u03bcs", 5 / 1e6, Unit::time},
                                         Conversion{"2 N\u00b7m/m3", 2, Unit::pressure}));

TEST(Quantity, DecimalPrefixesAreExact) {
  // "5 mm" must be the double nearest to 0.005, not 5 times the rounded 1e-3: cell counts depend on
  // it.
  EXPECT_EQ(parse_quantity("5 mm")->value, 0.005);
  EXPECT_EQ(parse_quantity("0.7 cm")->value, 0.7 / 100);
  EXPECT_EQ(parse_quantity("3 ms")->value, 0.003);
}

TEST(Quantity, WeightDensityIsNoDensity) {
  const auto quantity = parse_quantity("18 kN/m^3");
  ASSERT_TRUE(quantity);
  EXPECT_EQ(quantity->value, 18e3);
  EXPECT_FALSE(quantity->dimension == dimension_of(Unit::density));
}

TEST(Quantity, NamesAnUnknownUnit) {
  const auto quantity = parse_quantity("5 mn");
  ASSERT_TRUE(quantity);
  EXPECT_EQ(quantity->unknown_unit, "mn");
  EXPECT_EQ(parse_quantity("5 kg/mm^3/x")->unknown_unit, "x");
}

TEST(Quantity, ExpressionsAreNoQuantities) {
  for (const char* text : {"-9.81*min(t/2,1)", "2*x", "x", "", "1 + 2", "sin(t)", "3 m m/", "1e400",
                           "nan", "inf", "5 mm^x", "5 12", "5 m3.5", "5,0 mm", "2 \u00b3"}) {
    EXPECT_FALSE(parse_quantity(text)) << text;
  }
}

TEST(Quantity, EveryUnitReadsItsOwnSymbol) {
  for (const Unit unit : {Unit::length, Unit::time, Unit::mass, Unit::angle, Unit::velocity,
                          Unit::acceleration, Unit::rate, Unit::density, Unit::pressure,
                          Unit::force, Unit::viscosity, Unit::area, Unit::volume}) {
    const auto quantity = parse_quantity("2 " + unit_symbol(unit));
    ASSERT_TRUE(quantity) << unit_symbol(unit);
    EXPECT_EQ(quantity->value, 2) << unit_symbol(unit);
    EXPECT_TRUE(quantity->dimension == dimension_of(unit)) << unit_symbol(unit);
    EXPECT_NE(unit_quantity(unit), "");
    EXPECT_NE(unit_examples(unit), "");
  }
}

}  // namespace
}  // namespace scree

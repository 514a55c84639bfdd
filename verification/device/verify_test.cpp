// SPDX-License-Identifier: Apache-2.0
//
// A run of a verification case on the emulated device is the processor's.
#include <gtest/gtest.h>

#include "solver/deck/document.hpp"
#include "solver/device/toolkits.hpp"
#include "solver/emulation/launch.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify {
namespace {

constexpr const char* deck = R"(
title = "two rows of jelly"
[domain]
dimension = 2
lower = [0, 0]
upper = [1, 1]
cell_size = 0.1
[time]
end = 0.01
[method]
gravity = [0, -9.81]
[material.jelly]
model = "fixed_corotated"
density = 1000
youngs_modulus = 1e5
poissons_ratio = 0.3
[body.block]
material = "jelly"
shape = { type = "box", lower = [0.2, 0.1], upper = [0.6, 0.5] }
particles_per_direction = 2
velocity = [1, 0]
[boundary]
y_min = "slip"
[output]
every = 0.01
fields = ["velocity"]
[history]
every = 0.005
)";

Run run_on(const std::shared_ptr<const DeviceToolkit>& device) {
  Problems problems;
  const auto document = parse_document(deck, "deck.toml", problems);
  Run run;
  execute(run, *document, "deck.toml", device, problems, [] { return false; });
  EXPECT_TRUE(problems.empty()) << problems.text();
  EXPECT_EQ(run.fault, "");
  return run;
}

TEST(DeviceCases, run_on_the_device_that_was_chosen) {
  const verify::Run cpu = run_on(nullptr);
  const std::int64_t before = emulation::launches();
  const verify::Run device = run_on(emulated::make_toolkit());
  EXPECT_GT(emulation::launches(), before);
  ASSERT_EQ(cpu.history.size(), 3u);
  ASSERT_EQ(device.history.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    // Some steps from the same start: rounding only.
    EXPECT_NEAR(device.history[i].kinetic_energy, cpu.history[i].kinetic_energy,
                1e-12 * cpu.history[i].kinetic_energy);
  }
}

}  // namespace
}  // namespace scree::verify

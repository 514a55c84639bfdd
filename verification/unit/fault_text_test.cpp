// SPDX-License-Identifier: Apache-2.0
// The sentence with which a run ends.
#include "solver/simulation/fault_text.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

ParticleFault crushed() {
  ParticleFault fault;
  fault.code = FaultCode::inadmissible_state;
  fault.step = 7;
  fault.id = 3;
  fault.material = "clay";
  fault.value = 0.971;
  fault.dimension = 2;
  fault.position = {0.5, 0.25, 0};
  return fault;
}

TEST(FaultText, InadmissibleStateNamesItsVolume) {
  EXPECT_EQ(fault_text(crushed()),
            "step 7: particle 3 (clay) at (0.5, 0.25) m was deformed beyond what its material can "
            "represent (volume ratio J = 0.971); lower time.cfl, use more particles per direction "
            "or a stiffer material");
}

TEST(FaultText, TheLawsOwnWordsComeFirst) {
  ParticleFault fault = crushed();
  fault.inadmissible = InadmissibleText{"has melted", "cool it"};
  EXPECT_EQ(fault_text(fault),
            "step 7: particle 3 (clay) at (0.5, 0.25) m has melted (volume ratio J = 0.971); cool "
            "it");
}

TEST(FaultText, NamesTheKeyThatIsInForce) {
  for (const FaultCode code : {FaultCode::moved_too_far, FaultCode::inadmissible_state,
                               FaultCode::not_finite, FaultCode::left_domain}) {
    ParticleFault fault;
    fault.code = code;
    const std::string chosen = fault_text(fault);
    EXPECT_NE(chosen.find("time.cfl"), std::string::npos) << chosen;
    EXPECT_EQ(chosen.find("time.step"), std::string::npos) << chosen;
    fault.fixed_step = true;
    const std::string fixed = fault_text(fault);
    EXPECT_NE(fixed.find("lower time.step"), std::string::npos) << fixed;
    EXPECT_EQ(fixed.find("time.cfl"), std::string::npos) << fixed;
  }
}

}  // namespace
}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/case_code.hpp"

namespace scree::verify {

// The unit that CMake writes from the folders defines these.
#define SCREE_CASE(name) CaseCode case_##name();
#include "verification/cases/list.def"
#undef SCREE_CASE

const std::vector<CaseCode>& all_cases() {
  static const std::vector<CaseCode> cases{
#define SCREE_CASE(name) case_##name(),
#include "verification/cases/list.def"
#undef SCREE_CASE
  };
  return cases;
}

}  // namespace scree::verify

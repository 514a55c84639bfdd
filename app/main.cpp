// SPDX-License-Identifier: Apache-2.0
/// \file
/// The program: the only source of this room that knows the verification cases.
#include "app/cli.hpp"
#include "verification/suite/verify_command.hpp"

int main(int argc, char** argv) {
  return scree::scree_main(argc, argv, scree::verify::verify_command);
}

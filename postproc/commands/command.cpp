// SPDX-License-Identifier: Apache-2.0
#include "postproc/commands/command.hpp"

namespace scree {

#define SCREE_POST(name) PostCommand post_##name();
#include "postproc/commands/list.def"
#undef SCREE_POST

const std::vector<PostCommand>& post_commands() {
  static const std::vector<PostCommand> commands = {
#define SCREE_POST(name) post_##name(),
#include "postproc/commands/list.def"
#undef SCREE_POST
  };
  return commands;
}

}  // namespace scree

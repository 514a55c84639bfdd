// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "postproc/commands/option_set.hpp"

namespace scree {

/// What a command line may say to `scree post COMMAND` beside the command's own options.
struct PostWords {
  std::vector<std::string> after_dashes;  ///< the words behind "--", for the library underneath
  bool dashes = false;                    ///< whether "--" stood there
};

/// One command of `scree post`: a file in this folder and a line in list.def.
struct PostCommand {
  const char* name;
  const char* summary;
  bool takes_library_options;  ///< whether words may follow "--"
  /// Declares the options; the result runs the command after they have been parsed and returns the
  /// exit status. Throws UserError and RunFault.
  std::function<int(const PostWords&)> (*declare)(OptionSet& options);
};

/// All commands, in the order of list.def.
const std::vector<PostCommand>& post_commands();

}  // namespace scree

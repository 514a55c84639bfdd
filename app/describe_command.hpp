// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace scree {

/// The command line of `scree describe`.
struct DescribeOptions {
  std::string topic;  ///< empty: everything
  bool markdown = false;
  bool json_schema = false;
};

/// `scree describe`: prints the reference that the schemas hold. Throws UserError for an unknown
/// topic.
int describe_command(const DescribeOptions& options);

}  // namespace scree

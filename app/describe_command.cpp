// SPDX-License-Identifier: Apache-2.0
#include "app/describe_command.hpp"

#include <cstdio>

#include "app/reference.hpp"
#include "solver/base/error.hpp"
#include "solver/base/problems.hpp"

namespace scree {
namespace {

/// Throws unless the topic exists.
void require(const Reference& reference, const std::string& topic) {
  if (topic.empty() || !reference.find(topic).empty()) return;
  const auto topics = reference.topics();
  const std::string near = did_you_mean(topic, reference.names());
  throw UserError("there is no topic \"" + topic + "\"; topics: " + join(topics) +
                  (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
}

}  // namespace

int describe_command(const DescribeOptions& options) {
  const Reference reference;
  require(reference, options.topic);
  std::string text;
  if (options.json_schema) {
    if (!options.topic.empty()) throw UserError("--json-schema describes whole decks: no topic");
    text = reference_json_schema(reference);
  } else if (options.markdown) {
    text = reference_markdown(reference, options.topic);
  } else {
    text = reference_text(reference, options.topic);
  }
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace scree

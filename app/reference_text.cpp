// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include "app/reference.hpp"

/// The reference for a terminal, at most 100 columns wide.
namespace scree {
namespace {

constexpr std::size_t width = 100;

/// `text` broken at spaces, every line indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
      result += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? result : result + margin + line + "\n";
}

std::string entry_text(const Entry& entry) {
  std::string form = value_form(entry) + "; ";
  form += entry.required ? "required" : "default: " + default_form(entry);
  const std::string condition = condition_form(entry);
  if (!condition.empty()) form += " (" + condition + ")";
  return "  " + entry.key + "\n" + wrapped(form, 6) + wrapped(entry.doc, 6);
}

std::string section_text(const ReferenceSection& section) {
  const SchemaBase& schema = *section.schema;
  std::string text = schema.name() + "\n" + std::string(schema.name().size(), '=') + "\n";
  text += wrapped(schema.doc(), 0);
  const std::string places = join(section.places, "; ");
  if (!places.empty()) text += wrapped("Where: " + places, 0);
  if (!schema.text_shorthand().empty()) {
    text += wrapped("A bare text means " + schema.text_shorthand() + " alone.", 0);
  }
  if (!schema.number_shorthand().empty()) {
    text += wrapped("A bare number means " + schema.number_shorthand() + " alone.", 0);
  }
  text += "\n";
  for (const auto& entry : schema.entries()) text += entry_text(*entry);
  for (const Entry& entry : shared_entries(section)) text += entry_text(entry);
  for (const StateField& field : output_fields(section)) {
    text += wrapped("Output field " + field.name + " [" + field.unit + "]: " + field.doc, 2);
  }
  for (const std::string& source : schema.citations()) text += wrapped("Source: " + source, 0);
  return text;
}

}  // namespace

std::string reference_text(const Reference& reference, const std::string& topic) {
  std::string text;
  if (topic.empty()) {
    text += wrapped("Topics (scree describe TOPIC): " + join(reference.topics()) + ".", 0);
    text += wrapped(
        "A number is SI or a quoted number with a unit, \"5 mm\". d is domain.dimension. pi is "
        "defined in expressions.",
        0);
    text += "\n";
  }
  bool first = true;
  for (const ReferenceSection& section : reference.sections()) {
    const auto wanted = reference.find(topic);
    const bool shown =
        topic.empty() || std::find(wanted.begin(), wanted.end(), &section) != wanted.end();
    if (!shown) continue;
    if (!first) text += "\n";
    first = false;
    text += section_text(section);
  }
  return text;
}

}  // namespace scree

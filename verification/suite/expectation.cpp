// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/expectation.hpp"

#include <fmt/format.h>

#include "verification/suite/table_reader.hpp"

namespace scree::verify {
namespace {

struct KindName {
  const char* key;
  CheckKind kind;
  bool band;  ///< two limits
};

constexpr KindName kinds[] = {{"at_most", CheckKind::at_most, false},
                              {"at_least", CheckKind::at_least, false},
                              {"between", CheckKind::between, true},
                              {"within", CheckKind::within, false},
                              {"within_absolute", CheckKind::within_absolute, false},
                              {"order", CheckKind::order, true},
                              {"at_most_times", CheckKind::at_most_times, false},
                              {"at_least_times", CheckKind::at_least_times, false}};

void read_kind(TableReader& reader, const Value& table, Expectation& result) {
  std::vector<std::string> found, names;
  for (const KindName& known : kinds) {
    names.emplace_back(known.key);
    const std::vector<double> limits = reader.numbers(known.key);
    if (!reader.has(known.key)) continue;
    found.emplace_back(known.key);
    result.kind = known.kind;
    result.limits = limits;
    const std::size_t each = result.at.size();
    const bool fits =
        known.band ? limits.size() == 2 : limits.size() == 1 || (each > 0 && limits.size() == each);
    if (!fits)
      reader.report(*table.find(known.key), known.key, fmt::format("has {} numbers", limits.size()),
                    known.band ? "[lower, upper]" : "one number, or one for each entry of `at`");
  }
  if (found.size() != 1)
    reader.report(table, "",
                  found.empty() ? "says nothing about the quantity"
                                : "says several things at once: " + join(found),
                  "exactly one of " + join(names));
}

Expectation read_expectation(const Value& table, Problems& problems) {
  TableReader reader(table, "expect", problems);
  Expectation result;
  result.quantity = reader.text("quantity", true);
  result.norm = reader.text("norm");
  result.series = reader.texts("series");
  result.at = reader.numbers("at");
  read_kind(reader, table, result);
  result.than = reader.text("than");
  result.compared = reader.flag("compared").value_or(false);
  result.why = reader.text("why", true);
  const bool needs =
      result.kind == CheckKind::at_most_times || result.kind == CheckKind::at_least_times;
  if (needs != !result.than.empty())
    reader.report(table, "than", "names the other series of at_most_times and at_least_times");
  reader.finish();
  return result;
}

PeerResult read_peer(const Value& table, Problems& problems) {
  TableReader reader(table, "peer", problems);
  PeerResult result;
  result.code = reader.text("code", true);
  result.quantity = reader.text("quantity", true);
  result.series = reader.text("series", true);
  result.at = reader.numbers("at");
  result.values = reader.numbers("value");
  result.source = reader.text("source", true);
  if (result.at.empty() || result.at.size() != result.values.size())
    reader.report(table, "value", "has not one number for each entry of `at`");
  reader.finish();
  return result;
}

std::string limits_text(const std::vector<double>& limits) {
  std::string text;
  for (const double limit : limits)
    text += (text.empty() ? "" : ", ") + fmt::format("{:.3g}", limit);
  return text;
}

}  // namespace

CaseText read_case_text(const Value& document, Problems& problems) {
  TableReader reader(document, "", problems);
  CaseText result;
  result.title = reader.text("title", true);
  result.physics = reader.text("physics", true);
  result.reference = reader.text("reference", true);
  for (const Value* table : reader.tables("expect", true))
    result.expectations.push_back(read_expectation(*table, problems));
  for (const Value* table : reader.tables("peer"))
    result.peers.push_back(read_peer(*table, problems));
  reader.finish();
  return result;
}

std::string expected_text(const Expectation& e) {
  switch (e.kind) {
    case CheckKind::at_most:
      return "<= " + limits_text(e.limits);
    case CheckKind::at_least:
      return ">= " + limits_text(e.limits);
    case CheckKind::between:
      return fmt::format("{:.4g} to {:.4g}", e.limits[0], e.limits[1]);
    case CheckKind::within:
      return fmt::format("exact +- {} %", limits_text({100 * e.limits[0]}));
    case CheckKind::within_absolute:
      return "exact +- " + limits_text(e.limits);
    case CheckKind::order:
      return fmt::format("order {:.3g} to {:.3g}", e.limits[0], e.limits[1]);
    case CheckKind::at_most_times:
      return fmt::format("<= {} x {}", limits_text(e.limits), e.than);
    case CheckKind::at_least_times:
      return fmt::format(">= {} x {}", limits_text(e.limits), e.than);
  }
  return {};
}

}  // namespace scree::verify

// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/report_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "verification/suite/expectation.hpp"
#include "verification/suite/peers.hpp"

namespace scree::verify {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity and no NaN: they become texts.
Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json quantities(const Measured& measured) {
  Json list = Json::object();
  for (const Quantity& quantity : measured.quantities) {
    list[quantity.name] = {{"measured", number(quantity.value)}};
    if (quantity.exact) list[quantity.name]["exact"] = number(*quantity.exact);
  }
  return list;
}

Json run_json(const RunResult& run) {
  Json parameters = Json::object();
  for (const Parameter& parameter : run.plan.parameters.all()) {
    parameters[parameter.name] =
        parameter.number ? number(*parameter.number) : Json(parameter.text);
  }
  Json json{{"series", run.plan.series_name},  {"value", number(run.plan.value)},
            {"size", number(run.plan.size)},   {"label", run.plan.label},
            {"deck", run.plan.slug + ".toml"}, {"parameters", parameters},
            {"particles", run.particles},      {"steps", run.steps},
            {"seconds", number(run.seconds)},  {"quantities", quantities(run.measured)}};
  if (!run.fault.empty()) json["fault"] = run.fault;
  return json;
}

Json check_json(const CheckResult& check) {
  Json runs = Json::array();
  for (const Judged& judged : check.runs) {
    Json run{{"run", judged.run},
             {"value", number(judged.swept)},
             {"measured", number(judged.measured)},
             {"passed", judged.passed}};
    if (judged.exact) run["exact"] = number(*judged.exact);
    if (check.expectation.kind != CheckKind::order) run["limit"] = number(judged.limit);
    runs.push_back(run);
  }
  Json json{{"quantity", check.expectation.quantity},
            {"norm", check.expectation.norm},
            {"series", check.series},
            {"expected", expected_text(check.expectation)},
            {"runs", runs}};
  if (check.order) json["order"] = number(*check.order);
  json["verdict"] = check.passed ? "passed" : "failed";
  json["why"] = check.expectation.why;
  if (!check.remark.empty()) json["remark"] = check.remark;
  return json;
}

Json peers_json(const std::vector<CaseResult>& results) {
  Json list = Json::array();
  for (const PeerRow& row : peer_rows(results))
    list.push_back({{"case", row.case_name},
                    {"run", row.run},
                    {"quantity", row.peer->quantity},
                    {"code", row.peer->code},
                    {"theirs", number(row.theirs)},
                    {"measured", number(row.measured)},
                    {"source", row.peer->source}});
  return list;
}

Json case_json(const CaseResult& result) {
  Json runs = Json::array(), checks = Json::array();
  for (const RunResult& run : result.runs) runs.push_back(run_json(run));
  for (const CheckResult& check : result.checks) checks.push_back(check_json(check));
  return {{"name", result.name},
          {"title", result.text.title},
          {"physics", result.text.physics},
          {"reference", result.text.reference},
          {"verdict", result.passed ? "passed" : "failed"},
          {"seconds", number(result.seconds)},
          {"seconds_expected", number(result.sweep.seconds)},
          {"checks", checks},
          {"runs", runs},
          {"compared", quantities(result.compared)}};
}

}  // namespace

std::string report_json(const ReportHead& head, const std::vector<CaseResult>& results) {
  Json cases = Json::array();
  bool passed = true;
  for (const CaseResult& result : results) {
    cases.push_back(case_json(result));
    passed &= result.passed;
  }
  const Json json{{"program", "scree verify"},
                  {"version", head.version},
                  {"commit", head.commit},
                  {"compiler", head.compiler},
                  {"instruction_set", head.instruction_set},
                  {"cpu", head.cpu},
                  {"variant", head.variant},
                  {"date", head.date},
                  {"backend", head.backend},
                  {"threads", head.threads},
                  {"seconds", number(head.seconds)},
                  {"verdict", passed ? "passed" : "failed"},
                  {"peers", peers_json(results)},
                  {"cases", cases}};
  return json.dump(1) + "\n";
}

}  // namespace scree::verify

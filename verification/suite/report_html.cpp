// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "postproc/plot/svg_drawing.hpp"
#include "verification/suite/peers.hpp"
#include "verification/suite/report_figures.hpp"
#include "verification/suite/report_text.hpp"

namespace scree::verify {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "Helvetica Neue", Arial, sans-serif; color: #1d2125; margin: 0 auto;
  max-width: 1180px; padding: 24px; background: #fff; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 20px; margin: 44px 0 2px; border-top: 1px solid #d5d9dd;
  padding-top: 22px; } h3 { font-size: 15px; margin: 20px 0 6px; }
p { margin: 4px 0; } .quiet { color: #5c6670; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; margin: 10px 0; }
th, td { text-align: left; vertical-align: top; padding: 5px 10px 5px 0; border-bottom: 1px solid #e4e7ea; }
th { color: #5c6670; font-weight: 600; } td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
.passed { color: #1a7f37; font-weight: 600; } .failed { color: #c5221f; font-weight: 700; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(460px, 1fr)); gap: 18px; }
figure { margin: 8px 0; } figcaption { font-weight: 600; font-size: 14px; margin-bottom: 2px; }
figure svg { width: 100%; height: auto; } .why { color: #5c6670; max-width: 420px; }
details { margin: 8px 0; } summary { cursor: pointer; color: #5c6670; } a { color: #0b57a4; }
@media print { .figures { grid-template-columns: 1fr 1fr; } h2, figure { break-inside: avoid; } }
)";

std::string verdict(bool passed) {
  return passed ? "<span class=\"passed\">passed</span>" : "<span class=\"failed\">FAILED</span>";
}

std::string head_html(const ReportHead& head, const std::vector<CaseResult>& results) {
  std::size_t checks = 0, runs = 0, failed = 0;
  for (const CaseResult& result : results) {
    checks += result.checks.size();
    runs += result.runs.size();
    failed += !result.passed;
  }
  std::string text = "<h1>Verification of scree</h1>\n";
  text += fmt::format("<p>{} of {} cases passed: {} checks on {} runs, {} variant.</p>\n",
                      results.size() - failed, results.size(), checks, runs, head.variant);
  text += fmt::format(
      "<p class=\"quiet\">scree {}{}, {}, {}; {}; {}, {} thread{}, {:.0f} s; {}</p>\n",
      xml_text(head.version), head.commit.empty() ? "" : " (" + xml_text(head.commit) + ")",
      xml_text(head.compiler), xml_text(head.instruction_set), xml_text(head.cpu),
      xml_text(head.backend), head.threads, head.threads == 1 ? "" : "s", head.seconds,
      xml_text(head.date));
  return text;
}

std::string contents_html(const std::vector<CaseResult>& results) {
  std::string text =
      "<table><tr><th>case</th><th>physics</th><th>reference</th><th>runs</th><th>core "
      "seconds</th><th>verdict</th></tr>\n";
  for (const CaseResult& result : results) {
    text += fmt::format(
        "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td class=\"number\">{3}</td>"
        "<td class=\"number\">{4:.1f}</td><td>{5}</td></tr>\n",
        result.name, xml_text(result.text.physics), xml_text(result.text.reference),
        result.runs.size(), result.seconds, verdict(result.passed));
  }
  return text + "</table>\n";
}

/// "8: 0.0034, 16: 0.0024", the swept values before the numbers.
std::string all_measured(const CheckResult& check) {
  if (check.runs.empty()) return "nothing";
  std::string text;
  for (const Judged& run : check.runs) {
    if (!text.empty()) text += "<br>";
    if (check.runs.size() > 1)
      text += fmt::format("<span class=\"quiet\">{:g}:</span> ", run.swept);
    text += run.passed ? number_text(run.measured)
                       : "<span class=\"failed\">" + number_text(run.measured) + "</span>";
    if (run.exact) text += " <span class=\"quiet\">(" + number_text(*run.exact) + ")</span>";
  }
  return text;
}

std::string checks_html(const CaseResult& result) {
  std::string text =
      "<table><tr><th>quantity</th><th>series</th><th>expected</th><th>measured (exact)</th>"
      "<th>order</th><th>verdict</th><th>why</th></tr>\n";
  for (const CheckResult& check : result.checks) {
    const std::string norm =
        check.expectation.norm.empty()
            ? ""
            : "<br><span class=\"quiet\">" + xml_text(check.expectation.norm) + "</span>";
    text += fmt::format(
        "<tr><td>{}{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td>{}</td><td class=\"why\">{}{}</td></tr>\n",
        xml_text(check.expectation.quantity), norm, xml_text(check.series),
        xml_text(expected_text(check.expectation)), all_measured(check), order_text(check),
        verdict(check.passed), xml_text(check.expectation.why),
        check.remark.empty() ? "" : " <b>" + xml_text(check.remark) + "</b>");
  }
  return text + "</table>\n";
}

std::string runs_html(const CaseResult& result) {
  std::string text =
      "<details><summary>Runs</summary><table><tr><th>run</th><th>particles</th><th>steps</th>"
      "<th>core seconds</th><th>deck</th><th></th></tr>\n";
  for (const RunResult& run : result.runs) {
    text += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{:.1f}</td><td><a href=\"decks/{}/{}.toml\">{}.toml</a></td><td>{}</td>"
        "</tr>\n",
        xml_text(run.plan.label), run.particles, run.steps, run.seconds, result.name, run.plan.slug,
        run.plan.slug, xml_text(run.fault));
  }
  return text + "</table></details>\n";
}

std::string case_html(const CaseResult& result) {
  std::string text =
      fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}; {}. Case <code>{}</code>: {}</p>\n", result.name,
                  xml_text(result.text.title), xml_text(result.text.physics),
                  xml_text(result.text.reference), result.name, verdict(result.passed));
  text += checks_html(result);
  text += "<div class=\"figures\">\n";
  for (const Picture& picture : pictures(result)) {
    text += fmt::format("<figure><figcaption>{}</figcaption>{}</figure>\n", xml_text(picture.title),
                        picture.svg);
  }
  return text + "</div>\n" + runs_html(result);
}

}  // namespace

std::string report_html(const ReportHead& head, const std::vector<CaseResult>& results) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Verification of "
      "scree</title>\n<style>" +
      std::string(style) + "</style>\n</head>\n<body>\n";
  text += head_html(head, results) + contents_html(results) + peers_html(results);
  for (const CaseResult& result : results) text += case_html(result);
  return text + "</body>\n</html>\n";
}

}  // namespace scree::verify

// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/peers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "postproc/plot/svg_drawing.hpp"
#include "verification/suite/report_text.hpp"

namespace scree::verify {

std::vector<PeerRow> peer_rows(const std::vector<CaseResult>& results) {
  std::vector<PeerRow> rows;
  for (const CaseResult& result : results) {
    for (const PeerResult& peer : result.text.peers) {
      for (std::size_t i = 0; i < peer.at.size(); ++i) {
        for (const RunResult& run : result.runs) {
          const Quantity* const quantity = run.measured.find(peer.quantity);
          if (run.plan.series_name != peer.series || quantity == nullptr) continue;
          if (!same_swept(run.plan.value, peer.at[i])) continue;
          rows.push_back({result.name, &peer, run.plan.label, peer.values[i], quantity->value});
        }
      }
    }
  }
  return rows;
}

std::string peer_ratio(const PeerRow& row) {
  const double theirs = std::abs(row.theirs), measured = std::abs(row.measured);
  if (theirs == measured) return "equal";
  if (measured == 0) return "none";
  const double times = theirs > measured ? theirs / measured : measured / theirs;
  return fmt::format("{:.3g} times {}", times, theirs > measured ? "smaller" : "larger");
}

std::string peers_text(const std::vector<CaseResult>& results) {
  constexpr std::size_t columns = 5;
  std::vector<std::array<std::string, columns>> lines{
      {"run", "quantity", "other code", "theirs", "scree"}};
  for (const PeerRow& row : peer_rows(results)) {
    lines.push_back({row.case_name + ", " + row.run, row.peer->quantity, row.peer->code,
                     number_text(row.theirs), number_text(row.measured) + ", " + peer_ratio(row)});
  }
  if (lines.size() == 1) return {};
  std::array<std::size_t, columns> width{};
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < columns; ++c) width[c] = std::max(width[c], line[c].size());
  }
  std::string text = "Beside other codes\n";
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < columns; ++c)
      text += c + 1 < columns ? fmt::format("{:<{}}", line[c], width[c] + 2) : line[c] + "\n";
  }
  return text;
}

std::string peers_html(const std::vector<CaseResult>& results) {
  const std::vector<PeerRow> rows = peer_rows(results);
  if (rows.empty()) return {};
  std::string text =
      "<h2 id=\"peers\">Beside other codes</h2>\n<p>The same problems by the same measure; what "
      "differs stands beside the source.</p>\n<table><tr><th>case</th><th>run</th><th>quantity</th>"
      "<th>other code</th><th>theirs</th><th>scree</th><th></th><th>source</th></tr>\n";
  for (const PeerRow& row : rows) {
    text += fmt::format(
        "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td>"
        "<td class=\"number\">{4}</td><td class=\"number\">{5}</td><td class=\"number\">{6}</td>"
        "<td class=\"why\">{7}</td></tr>\n",
        row.case_name, xml_text(row.run), xml_text(row.peer->quantity), xml_text(row.peer->code),
        number_text(row.theirs), number_text(row.measured), peer_ratio(row),
        xml_text(row.peer->source));
  }
  return text + "</table>\n";
}

}  // namespace scree::verify

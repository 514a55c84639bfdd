// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::verify {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Position of a swept value in `at`; 0 for all where `at` is empty, none if it is not there.
std::optional<std::size_t> place(const std::vector<double>& at, double value) {
  if (at.empty()) return 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (same_swept(at[i], value)) return i;
  }
  return std::nullopt;
}

class Judge {
 public:
  explicit Judge(CaseResult& result) : result_(result) {}

  void all() {
    for (const Expectation& expectation : result_.text.expectations) {
      if (expectation.compared) {
        add_compared(expectation);
        continue;
      }
      for (const Series& series : result_.sweep.series) {
        if (contains(expectation.series, series.name)) add(expectation, series.name);
      }
    }
    result_.passed = !result_.runs.empty();
    for (const CheckResult& check : result_.checks) result_.passed &= check.passed;
    for (const RunResult& run : result_.runs) {
      result_.passed &= run.fault.empty() || run.plan.may_fail;
      result_.seconds += run.seconds;
    }
  }

 private:
  /// The runs of a series that an expectation is about, coarse ones first.
  std::vector<const RunResult*> runs_of(const Expectation& expectation,
                                        const std::string& series) const {
    std::vector<const RunResult*> runs;
    for (const RunResult& run : result_.runs) {
      if (run.plan.series_name == series && place(expectation.at, run.plan.value))
        runs.push_back(&run);
    }
    std::stable_sort(runs.begin(), runs.end(), [](const RunResult* a, const RunResult* b) {
      return a->plan.size > b->plan.size;
    });
    return runs;
  }

  static double failed_value() { return std::numeric_limits<double>::infinity(); }

  void add(const Expectation& expectation, const std::string& series) {
    const auto runs = runs_of(expectation, series);
    if (runs.empty()) return;  // the other variant has them
    CheckResult check{expectation, series, {}, std::nullopt, true, ""};
    for (const RunResult* run : runs) add_run(check, *run);
    if (expectation.kind == CheckKind::order) {
      set_order(check, runs);
      judge_order(check);
    }
    result_.checks.push_back(std::move(check));
  }

  void add_run(CheckResult& check, const RunResult& run) const {
    Judged judged{run.plan.label, run.plan.value, failed_value(), std::nullopt, 0, false};
    if (run.fault.empty()) {
      const Quantity* const quantity = run.measured.find(check.expectation.quantity);
      if (quantity == nullptr) {
        check.remark = "exact.hpp gives no quantity of this name";
        check.passed = false;
        return;
      }
      judged.measured = quantity->value;
      judged.exact = quantity->exact;
    } else if (!run.plan.may_fail) {
      check.remark = "the run failed: " + run.fault;
      judged.measured = std::numeric_limits<double>::quiet_NaN();
    }
    if (check.expectation.kind == CheckKind::order) {
      judged.passed = true;
    } else {
      apply(check, judged);
    }
    check.passed &= judged.passed;
    check.runs.push_back(std::move(judged));
  }

  /// The same quantity in the series that the expectation compares with.
  std::optional<double> other(const Expectation& expectation, double swept) const {
    for (const RunResult& run : result_.runs) {
      if (run.plan.series_name != expectation.than || !place({swept}, run.plan.value)) continue;
      if (!run.fault.empty()) return failed_value();
      const Quantity* const quantity = run.measured.find(expectation.quantity);
      if (quantity != nullptr) return quantity->value;
    }
    return std::nullopt;
  }

  void apply(CheckResult& check, Judged& judged) const {
    const Expectation& e = check.expectation;
    const auto index = place(e.at, judged.swept).value_or(0);
    judged.limit = e.limits[e.limits.size() > 1 && e.kind != CheckKind::between ? index : 0];
    const double m = judged.measured;
    switch (e.kind) {
      case CheckKind::at_most:
        judged.passed = m <= judged.limit;
        return;
      case CheckKind::at_least:
        judged.passed = m >= judged.limit;
        return;
      case CheckKind::between:
        judged.passed = m >= e.limits[0] && m <= e.limits[1];
        if (m > 0.5 * (e.limits[0] + e.limits[1])) judged.limit = e.limits[1];
        return;
      case CheckKind::within:
      case CheckKind::within_absolute: {
        if (!judged.exact) {
          check.remark = "exact.hpp gives no exact value";
          return;
        }
        const double scale = e.kind == CheckKind::within ? std::abs(*judged.exact) : 1;
        judged.passed = std::abs(m - *judged.exact) <= judged.limit * scale;
        return;
      }
      case CheckKind::at_most_times:
      case CheckKind::at_least_times: {
        const auto reference = other(e, judged.swept);
        if (!reference) {
          check.remark = "the series \"" + e.than + "\" has no such run";
          return;
        }
        judged.limit *= *reference;
        judged.passed = e.kind == CheckKind::at_most_times ? m <= judged.limit : m >= judged.limit;
        return;
      }
      case CheckKind::order:
        return;
    }
  }

  static void set_order(CheckResult& check, const std::vector<const RunResult*>& runs) {
    const std::size_t n = check.runs.size();
    if (n < 2 || runs.size() != n) return;
    const double order = observed_order(check.runs[n - 2].measured, runs[n - 2]->plan.size,
                                        check.runs[n - 1].measured, runs[n - 1]->plan.size);
    if (std::isfinite(order)) check.order = order;
  }

  static void judge_order(CheckResult& check) {
    const auto& band = check.expectation.limits;
    if (!check.order) {
      if (check.remark.empty()) check.remark = "an order needs two runs with positive errors";
      check.passed = false;
      return;
    }
    check.passed &= *check.order >= band[0] && *check.order <= band[1];
  }

  void add_compared(const Expectation& expectation) {
    CheckResult check{expectation, "all runs", {}, std::nullopt, false, ""};
    Judged judged{"all runs", 0, 0, std::nullopt, 0, false};
    const Quantity* const quantity = result_.compared.find(expectation.quantity);
    if (quantity == nullptr) {
      check.remark = "not measured: a run failed, or exact.hpp's compare() does not give it";
    } else {
      judged.measured = quantity->value;
      judged.exact = quantity->exact;
      apply(check, judged);
      check.passed = judged.passed;
      check.runs.push_back(std::move(judged));
    }
    result_.checks.push_back(std::move(check));
  }

  CaseResult& result_;
};

}  // namespace

void check_names(const CaseText& text, const Sweep& sweep, const Value& document,
                 Problems& problems) {
  const auto complain = [&](const std::string& message, const std::string& allowed) {
    problems.add({document.position, "expect", "", message, allowed, ""});
  };
  std::vector<std::string> names;
  for (const Series& series : sweep.series) names.push_back(series.name);
  const auto check = [&](const std::string& quantity, const std::vector<std::string>& used,
                         const std::vector<std::string>& own, const std::vector<double>& at) {
    for (const std::string& name : used) {
      if (!contains(names, name))
        complain("\"" + name + "\" is no series", "case.toml has " + join(names, "; "));
    }
    for (const double value : at) {
      bool found = false;
      for (const Series& series : sweep.series) {
        if (!contains(own, series.name)) continue;
        found |= (!series.ci.empty() && place(series.ci, value)) ||
                 (!series.full.empty() && place(series.full, value));
      }
      if (!found) complain(fmt::format("{}: no run at {:g}", quantity, value), "");
    }
  };
  for (const Expectation& e : text.expectations) {
    std::vector<std::string> used = e.series;
    if (!e.than.empty()) used.push_back(e.than);
    check(e.quantity, used, e.series, e.at);
  }
  for (const PeerResult& peer : text.peers)
    check(peer.quantity, {peer.series}, {peer.series}, peer.at);
}

bool same_swept(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(b), 1.0); }

void judge(CaseResult& result) { Judge(result).all(); }

double observed_order(double coarse, double coarse_size, double fine, double fine_size) {
  return std::log(coarse / fine) / std::log(coarse_size / fine_size);
}

}  // namespace scree::verify

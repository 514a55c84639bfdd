// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "verification/suite/table_reader.hpp"

namespace scree::verify {
namespace {

/// Letters, digits and single underscores.
std::string file_name(const std::string& label) {
  std::string name;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-') {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

/// `[sweep.parameters]` and a series' `with` hold numbers, texts, and expressions of earlier ones
/// in braces, which are worked out for each run.
void check_parameters(const Value* table, const std::string& path, Problems& problems) {
  if (table == nullptr) return;
  for (const Value& item : table->items) {
    if (item.is_number() || item.is(Value::Kind::text)) continue;
    problems.add({item.position, path + "." + item.key, "", "is " + kind_name(item.kind),
                  "must be a number, a text, or an expression in braces", ""});
  }
}

void set_value(Parameters& parameters, const Value& item, Problems& problems) {
  Value filled = item;
  parameters.fill(filled, "sweep.parameters." + item.key, problems);
  if (filled.is_number()) {
    parameters.set(item.key, filled.number());
  } else {
    parameters.set(item.key, filled.text);
  }
}

/// The parameters of one run: the table's in its order, those of the series and the swept one in
/// their place.
Parameters parameters_of(const Value* table, const Value* with, const std::string& over,
                         double value, bool full, Problems& problems) {
  Parameters result;
  result.set("full", full ? 1 : 0);
  if (table == nullptr) return result;
  for (const Value& item : table->items) {
    const Value* const chosen = with != nullptr ? with->find(item.key) : nullptr;
    if (item.key == over) {
      result.set(over, value);
    } else {
      set_value(result, chosen != nullptr ? *chosen : item, problems);
    }
  }
  return result;
}

class SweepReader {
 public:
  SweepReader(const Value& sweep, bool full, Problems& problems)
      : reader_(sweep, "sweep", problems), full_(full), problems_(problems) {}

  Sweep read() {
    result_.over = reader_.text("over");
    result_.size_label = reader_.text("size_label");
    result_.seconds = reader_.number("seconds").value_or(0);
    const Value* const table = reader_.any("parameters");
    if (table != nullptr && table->is(Value::Kind::table)) parameters_ = table;
    check_parameters(parameters_, "sweep.parameters", problems_);
    size_ = reader_.any("size");
    for (const Value* series : reader_.tables("series", true)) read_series(*series);
    reader_.finish();
    if (result_.size_label.empty()) {
      result_.size_label = size_ != nullptr ? "size" : "1/" + result_.over;
    }
    return std::move(result_);
  }

 private:
  void read_series(const Value& table) {
    TableReader reader(table, "sweep.series", problems_);
    Series series;
    series.name = reader.text("name", true);
    series.over = reader.text("over");
    if (series.over.empty()) series.over = result_.over;
    series.ci = reader.numbers("ci");
    series.full = reader.has("full") ? reader.numbers("full") : series.ci;
    series.may_fail = reader.flag("may_fail").value_or(false);
    const Value* with = reader.any("with");
    if (with != nullptr && !with->is(Value::Kind::table)) {
      reader.report(*with, "with", "is " + kind_name(with->kind), "must be a table");
      with = nullptr;
    }
    check_parameters(with, "sweep.series.with", problems_);
    check_names(reader, table, series, with);
    reader.finish();
    result_.series.push_back(series);
    for (const double value : full_ ? series.full : series.ci) plan(series, with, value);
  }

  void check_names(TableReader& reader, const Value& table, const Series& series,
                   const Value* with) {
    std::vector<std::string> names;
    if (parameters_ != nullptr) {
      for (const Value& item : parameters_->items) names.push_back(item.key);
    }
    const auto check = [&](const Value& where, const std::string& key, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) != names.end()) return;
      reader.report(where, key, "\"" + name + "\" is no parameter",
                    "sweep.parameters has " + join(names));
    };
    check(table, "over", series.over);
    if (with == nullptr) return;
    for (const Value& item : with->items) check(item, "with", item.key);
  }

  void plan(const Series& series, const Value* with, double value) {
    RunPlan run;
    run.series = result_.series.size() - 1;
    run.series_name = series.name;
    run.value = value;
    run.label = fmt::format("{}, {} = {:g}", series.name, series.over, value);
    run.slug = file_name(run.label);
    run.may_fail = series.may_fail;
    run.parameters = parameters_of(parameters_, with, series.over, value, full_, problems_);
    run.size = 1 / value;
    if (size_ != nullptr) {
      Value filled = *size_;
      run.parameters.fill(filled, "sweep.size", problems_);
      if (filled.is_number()) {
        run.size = filled.number();
      } else {
        reader_.report(*size_, "size", "is no number", "must be one or an expression in braces");
      }
    }
    result_.runs.push_back(std::move(run));
  }

  TableReader reader_;
  bool full_;
  Problems& problems_;
  const Value* parameters_ = nullptr;
  const Value* size_ = nullptr;
  Sweep result_;
};

}  // namespace

Sweep read_sweep(const Value& document, bool full, Problems& problems) {
  const Value* const sweep = document.find("sweep");
  if (sweep == nullptr || !sweep->is(Value::Kind::table)) {
    problems.add({document.position, "sweep", "", "is missing",
                  "a case says with [sweep] which runs it consists of", ""});
    return {};
  }
  return SweepReader(*sweep, full, problems).read();
}

Value deck_of(const Value& document, const Parameters& parameters, Problems& problems) {
  Value deck = document;
  std::erase_if(deck.items, [](const Value& item) { return item.key == "sweep"; });
  parameters.fill(deck, "", problems);
  return deck;
}

}  // namespace scree::verify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"

namespace scree::verify {

/// Reads the keys of one table of a case's files, which its author writes; every mistake is
/// reported with its place.
class TableReader {
 public:
  TableReader(const Value& table, std::string path, Problems& problems)
      : table_(table), path_(std::move(path)), problems_(problems) {}
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;

  bool has(const std::string& key) const { return table_.find(key) != nullptr; }
  /// A member of any kind, or nullptr.
  const Value* any(const std::string& key);
  std::optional<double> number(const std::string& key);
  std::optional<bool> flag(const std::string& key);
  std::string text(const std::string& key, bool required = false);
  /// One text or an array of them.
  std::vector<std::string> texts(const std::string& key);
  /// One number or an array of them.
  std::vector<double> numbers(const std::string& key);
  /// The tables of an array [[key]].
  std::vector<const Value*> tables(const std::string& key, bool required = false);

  void report(const Value& where, const std::string& key, const std::string& message,
              const std::string& allowed = "");
  /// Reports all members that were not asked for.
  void finish();

 private:
  const Value* of_kind(const std::string& key, const std::function<bool(const Value&)>& fits,
                       const std::string& allowed);

  const Value& table_;
  std::string path_;
  Problems& problems_;
  std::vector<std::string> known_;
};

}  // namespace scree::verify

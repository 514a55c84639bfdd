// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "solver/io/state_archive.hpp"

namespace scree {

/// A state kept in memory: what was put can be read from the same object.
class MemoryArchive : public StateWriter, public StateReader {
 public:
  void put_text(const std::string& name, const std::string& text) override;
  bool has(const std::string& name) const override;
  std::string text(const std::string& name) const override;

  /// True if both hold the same names, types and bits.
  friend bool operator==(const MemoryArchive& a, const MemoryArchive& b) {
    return a.entries_ == b.entries_;
  }

 protected:
  void put_array(const std::string& name, ElementType type, const void* values,
                 std::size_t count) override;
  std::size_t array_size(const std::string& name, ElementType type) const override;
  void read_array(const std::string& name, ElementType type, void* values,
                  std::size_t count) const override;

 private:
  struct Entry {
    ElementType type = ElementType::uint8;
    bool is_text = false;
    std::vector<std::uint8_t> bytes;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  void insert(const std::string& name, Entry entry);
  const Entry& find(const std::string& name, ElementType type, bool is_text) const;

  std::map<std::string, Entry> entries_;
};

}  // namespace scree

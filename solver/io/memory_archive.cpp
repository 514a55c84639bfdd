// SPDX-License-Identifier: Apache-2.0
#include "solver/io/memory_archive.hpp"

#include <cstring>

#include "solver/base/error.hpp"

namespace scree {

void StateReader::fail_not_single(const std::string& name, std::size_t count) {
  throw RunFault("saved state: '" + name + "' holds " + std::to_string(count) +
                 " numbers where one is expected");
}

void MemoryArchive::insert(const std::string& name, Entry entry) {
  if (!entries_.emplace(name, std::move(entry)).second) {
    throw std::logic_error("saved state: '" + name + "' was put twice");
  }
}

const MemoryArchive::Entry& MemoryArchive::find(const std::string& name, ElementType type,
                                                bool is_text) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) throw RunFault("saved state: '" + name + "' is missing");
  if (found->second.type != type || found->second.is_text != is_text) {
    throw RunFault("saved state: '" + name + "' holds another type of value");
  }
  return found->second;
}

void MemoryArchive::put_text(const std::string& name, const std::string& text) {
  insert(name, {ElementType::uint8, true, {text.begin(), text.end()}});
}

bool MemoryArchive::has(const std::string& name) const { return entries_.contains(name); }

std::string MemoryArchive::text(const std::string& name) const {
  const Entry& entry = find(name, ElementType::uint8, true);
  return {entry.bytes.begin(), entry.bytes.end()};
}

void MemoryArchive::put_array(const std::string& name, ElementType type, const void* values,
                              std::size_t count) {
  const auto* bytes = static_cast<const std::uint8_t*>(values);
  insert(name, {type, false, {bytes, bytes + count * element_size(type)}});
}

std::size_t MemoryArchive::array_size(const std::string& name, ElementType type) const {
  return find(name, type, false).bytes.size() / element_size(type);
}

void MemoryArchive::read_array(const std::string& name, ElementType type, void* values,
                               std::size_t count) const {
  if (count == 0) return;
  std::memcpy(values, find(name, type, false).bytes.data(), count * element_size(type));
}

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#include "solver/io/state_buffer.hpp"

#include <type_traits>

namespace scree {

void StateBuffer::put_text(const std::string& name, const std::string& text) {
  entries_.push_back({name, text});
}

template <ArchiveElement T>
void StateBuffer::keep(const std::string& name, const void* values, std::size_t count) {
  const T* first = static_cast<const T*>(values);
  entries_.push_back({name, std::vector<T>(first, first + count)});
}

void StateBuffer::put_array(const std::string& name, ElementType type, const void* values,
                            std::size_t count) {
  switch (type) {
    case ElementType::float64:
      return keep<double>(name, values, count);
    case ElementType::float32:
      return keep<float>(name, values, count);
    case ElementType::int64:
      return keep<std::int64_t>(name, values, count);
    case ElementType::int32:
      return keep<std::int32_t>(name, values, count);
    case ElementType::uint8:
      return keep<std::uint8_t>(name, values, count);
  }
}

void StateBuffer::replay(StateWriter& out) const {
  for (const Entry& entry : entries_) {
    std::visit(
        [&](const auto& values) {
          if constexpr (std::is_same_v<decltype(values), const std::string&>) {
            out.put_text(entry.name, values);
          } else {
            out.put(entry.name, values);
          }
        },
        entry.values);
  }
}

}  // namespace scree

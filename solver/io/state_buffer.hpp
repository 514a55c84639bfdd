// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "solver/io/state_archive.hpp"

namespace scree {

/// A copy of a state on its way to a file: keeps what is put, in order, and hands it on later,
/// perhaps on another thread.
class StateBuffer : public StateWriter {
 public:
  void put_text(const std::string& name, const std::string& text) override;

  /// Puts everything into `out`, in the order in which it came. Throws what `out` throws.
  void replay(StateWriter& out) const;

 protected:
  void put_array(const std::string& name, ElementType type, const void* values,
                 std::size_t count) override;

 private:
  using Values =
      std::variant<std::string, std::vector<double>, std::vector<float>, std::vector<std::int64_t>,
                   std::vector<std::int32_t>, std::vector<std::uint8_t>>;
  struct Entry {
    std::string name;
    Values values;
  };

  template <ArchiveElement T>
  void keep(const std::string& name, const void* values, std::size_t count);

  std::vector<Entry> entries_;
};

}  // namespace scree

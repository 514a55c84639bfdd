// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where a simulation saves its state to and loads it from: named arrays of numbers and texts.
/// What is put comes back bit for bit. Names may hold '/', which a file shows as folders.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scree {

enum class ElementType : std::uint8_t { float64, float32, int64, int32, uint8 };

template <class T>
concept ArchiveElement = std::same_as<T, double> || std::same_as<T, float> ||
    std::same_as<T, std::int64_t> || std::same_as<T, std::int32_t> || std::same_as<T, std::uint8_t>;

template <ArchiveElement T>
constexpr ElementType element_type() {
  if constexpr (std::same_as<T, double>) return ElementType::float64;
  if constexpr (std::same_as<T, float>) return ElementType::float32;
  if constexpr (std::same_as<T, std::int64_t>) return ElementType::int64;
  if constexpr (std::same_as<T, std::int32_t>) return ElementType::int32;
  return ElementType::uint8;
}

constexpr std::size_t element_size(ElementType type) {
  switch (type) {
    case ElementType::float64:
    case ElementType::int64:
      return 8;
    case ElementType::float32:
    case ElementType::int32:
      return 4;
    case ElementType::uint8:
      return 1;
  }
  return 0;
}

/// Takes a state. A name may be put once. Throws RunFault where the archive cannot take it.
class StateWriter {
 public:
  virtual ~StateWriter() = default;

  template <ArchiveElement T>
  void put(const std::string& name, std::span<const T> values) {
    put_array(name, element_type<T>(), values.data(), values.size());
  }
  template <ArchiveElement T>
  void put(const std::string& name, const std::vector<T>& values) {
    put(name, std::span<const T>(values));
  }
  /// A single number, an array of one.
  template <ArchiveElement T>
  void put_value(const std::string& name, T value) {
    put(name, std::span<const T>(&value, 1));
  }
  virtual void put_text(const std::string& name, const std::string& text) = 0;

 protected:
  virtual void put_array(const std::string& name, ElementType type, const void* values,
                         std::size_t count) = 0;
};

/// Gives a state back. Throws RunFault where a name is missing or holds another type.
class StateReader {
 public:
  virtual ~StateReader() = default;

  virtual bool has(const std::string& name) const = 0;
  virtual std::string text(const std::string& name) const = 0;

  template <ArchiveElement T>
  std::vector<T> get(const std::string& name) const {
    std::vector<T> values(array_size(name, element_type<T>()));
    read_array(name, element_type<T>(), values.data(), values.size());
    return values;
  }
  /// The single number put by put_value.
  template <ArchiveElement T>
  T get_value(const std::string& name) const {
    const std::vector<T> values = get<T>(name);
    if (values.size() != 1) fail_not_single(name, values.size());
    return values[0];
  }

 protected:
  /// Number of elements; throws RunFault if there is no array of this name and type.
  virtual std::size_t array_size(const std::string& name, ElementType type) const = 0;
  virtual void read_array(const std::string& name, ElementType type, void* values,
                          std::size_t count) const = 0;
  [[noreturn]] static void fail_not_single(const std::string& name, std::size_t count);
};

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

#include "solver/device/device.hpp"

namespace scree {

/// An array in a device's memory.
template <class X>
class DeviceArray {
 public:
  static_assert(std::is_trivially_copyable_v<X>);

  /// what: names the memory where it does not fit.
  DeviceArray(Device& device, const char* what) : device_(&device), what_(what) {}
  ~DeviceArray() { device_->release(data_); }
  DeviceArray(DeviceArray&& other) noexcept
      : device_(other.device_),
        what_(other.what_),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(what_, other.what_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }

  X* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return capacity_ * sizeof(X); }

  /// Changes the size; the content is lost where more memory is needed, which is then an eighth
  /// more than asked for.
  void resize(std::size_t n) {
    if (n > capacity_) {
      const std::size_t room = capacity_ == 0 ? n : n + n / 8;
      free();
      data_ = static_cast<X*>(device_->allocate(room * sizeof(X), what_));
      capacity_ = room;
    }
    size_ = n;
  }
  void free() {
    device_->release(std::exchange(data_, nullptr));
    size_ = capacity_ = 0;
  }
  void zero() {
    if (size_ > 0) device_->zero(data_, size_ * sizeof(X));
  }
  /// Takes all of a std::vector-like array.
  template <class Array>
  void upload(const Array& from) {
    static_assert(std::is_same_v<typename Array::value_type, X>);
    resize(from.size());
    if (size_ > 0) device_->upload(data_, from.data(), size_ * sizeof(X));
  }
  /// Gives the first `size()` entries to a std::vector-like array.
  template <class Array>
  void download(Array& to) const {
    static_assert(std::is_same_v<typename Array::value_type, X>);
    to.resize(size_);
    if (size_ > 0) device_->download(to.data(), data_, size_ * sizeof(X));
  }

 private:
  Device* device_;
  const char* what_;
  X* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace scree

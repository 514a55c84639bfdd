// SPDX-License-Identifier: Apache-2.0
#include "solver/io/hdf5_handle.hpp"

#include <hdf5.h>

#include <cstring>
#include <type_traits>

#include "solver/base/foreign_leaks.hpp"

namespace scree {

static_assert(std::is_same_v<Hdf5Id, hid_t> && std::is_same_v<int, herr_t>);

namespace {

herr_t find_system_message(unsigned, const H5E_error2_t* error, void* found) {
  // The low level driver reports "... errno = 28, error message = 'No space left on device', ...".
  const char* start = error->desc ? std::strstr(error->desc, "error message = '") : nullptr;
  if (!start) return 0;
  start += std::strlen("error message = '");
  const char* end = std::strchr(start, '\'');
  *static_cast<std::string*>(found) = end ? std::string(start, end) : std::string(start);
  return 1;
}

}  // namespace

void start_hdf5() {
  static const bool started = [] {
    overlook_foreign_leaks();
    H5dont_atexit();
    H5open();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  (void)started;
}

std::string hdf5_system_message() {
  std::string found;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_system_message, &found);
  return found.empty() ? found : ": " + found;
}

Hdf5Id hdf5_type(ElementType type) {
  switch (type) {
    case ElementType::float64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::float32:
      return H5T_NATIVE_FLOAT;
    case ElementType::int64:
      return H5T_NATIVE_INT64;
    case ElementType::int32:
      return H5T_NATIVE_INT32;
    case ElementType::uint8:
      return H5T_NATIVE_UINT8;
  }
  return -1;
}

}  // namespace scree

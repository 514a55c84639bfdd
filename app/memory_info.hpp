// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace scree {

/// Memory that this process holds at present [bytes]; 0 where the system does not tell.
std::int64_t resident_memory();

/// The most that it has held [bytes], since reset_peak_memory() where that worked.
std::int64_t peak_memory();

/// Lets the peak begin again at the present; false where the system does not allow it.
bool reset_peak_memory();

/// Memory that can still be had without swapping [bytes]; nothing where the system does not tell.
std::optional<std::int64_t> free_memory();

}  // namespace scree

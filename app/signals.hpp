// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// While it lives, SIGINT, SIGTERM and SIGHUP only leave a note, so that a run can stop between
/// two steps; a file that grows beyond the system's limit and a closed terminal become errors of
/// the write instead of signals. One at a time. Afterwards the former handlers are back.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals();

  /// Number of the last signal that asked to stop, 0 if none did.
  static int received();
};

}  // namespace scree

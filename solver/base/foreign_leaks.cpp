// SPDX-License-Identifier: Apache-2.0
#include "solver/base/foreign_leaks.hpp"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 does not free a file that it could not flush to a full disk. Open MPI, which PETSc
/// starts, keeps memory to the end of the process; whose asprintf it was, its stack does not tell
/// (this program formats with fmt).
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\nleak:libmpi.so\nleak:libopen-\nleak:libhwloc\nleak:libpmix\nleak:libevent\n"
         "leak:mca_\nleak:__vasprintf_internal\n";
}
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
/// Open MPI unloads its plug-ins before leaks are looked for, so that nobody could tell any more
/// whose memory it is: they stay loaded.
extern "C" int dlclose(void* /*library*/) { return 0; }
#endif

namespace scree {

void overlook_foreign_leaks() {}

}  // namespace scree

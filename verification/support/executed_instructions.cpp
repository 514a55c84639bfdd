// SPDX-License-Identifier: Apache-2.0
#include "verification/support/executed_instructions.hpp"

#if defined(__linux__) && defined(__x86_64__) && defined(__GNUC__)
#define SCREE_CAN_STEP 1
#include <csignal>

#include <ucontext.h>
#endif

namespace scree::testing {

#ifdef SCREE_CAN_STEP
namespace {

Executed counted;  // by the signal's handler

/// PREFETCHh is 0F 18 /0 to /3, PREFETCHW and PREFETCHWT1 0F 0D /1 and /2; a REX prefix may stand
/// before them.
bool is_prefetch(const unsigned char* code) {
  if ((*code & 0xf0) == 0x40) ++code;
  if (code[0] != 0x0f) return false;
  const int operation = code[2] >> 3 & 7;
  if (code[1] == 0x18) return operation <= 3;
  return code[1] == 0x0d && (operation == 1 || operation == 2);
}

/// Comes before each instruction.
void count_instruction(int, siginfo_t*, void* context) {
  const greg_t place = static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP];
  ++counted.instructions;
  if (is_prefetch(reinterpret_cast<const unsigned char*>(place))) ++counted.prefetches;
}

constexpr unsigned long long trap_flag = 0x100;

}  // namespace

Executed executed_instructions(const std::function<void()>& f) {
  struct sigaction action {};
  struct sigaction before {};
  action.sa_sigaction = count_instruction;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGTRAP, &action, &before);
  counted = {};
  __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() | trap_flag);
  f();
  __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() & ~trap_flag);
  sigaction(SIGTRAP, &before, nullptr);
  return counted;
}

/// Not every emulated machine heeds the trap flag.
bool can_count_instructions() {
  return executed_instructions([] {}).instructions > 0;
}
#else
bool can_count_instructions() { return false; }

Executed executed_instructions(const std::function<void()>& f) {
  f();
  return {};
}
#endif

}  // namespace scree::testing

// SPDX-License-Identifier: Apache-2.0
//
// What the compiler makes of the fused pass: it prefetches, and takes no more instructions a
// particle than it did. GCC 12 once dropped prefetches without a word, which took up to 30 % of a
// step.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "materials/registry.hpp"
#include "materials/typical_input.hpp"
#include "solver/step/body.hpp"
#include "verification/support/block_scene.hpp"
#include "verification/support/executed_instructions.hpp"

namespace scree::testing {
namespace {

/// Why a figure of this build would say nothing; empty where it does.
std::string excuse() {
#if !defined(__GNUC__) || defined(__clang__) || __GNUC__ != 12
  return "the figures are those of GCC 12";
#elif !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    defined(SCREE_STRICT) || defined(SCREE_ASSERTIONS)
  return "instrumented or unoptimised code";
#else
  return can_count_instructions() ? "" : "no way to step through a program here";
#endif
}

/// Instructions a particle with GCC 12.2, -O3, in single and double precision.
struct Figures {
  double single, twice;
};

/// Those with the vectors of this build, of 32 or 64 bytes; none are known for others.
Figures figures([[maybe_unused]] Figures avx2, [[maybe_unused]] Figures avx512) {
#if defined(__AVX512F__)
  return avx512;
#elif defined(__AVX2__)
  return avx2;
#else
  return {1e9, 1e9};
#endif
}

/// One block of random particles; it comes `times` times, one after the other.
template <class T>
class Pass {
 public:
  Pass(const char* model, int particles)
      : body_(make(model)), scene_(2, {particles}, 7, body_->store().fields() - Scene::fields) {}

  Executed over_blocks(std::size_t times) {
    PassData<3, T> data = scene_.data();
    data.layout = AuxLayout{};  // of a run without pore water that records nothing
    data.parameters.dt = data.parameters.dt_next = T(1e-3);
    data.parameters.derive();
    Executor executor(1);
    const std::vector<std::int32_t> blocks(times, 0);
    const auto pass = [&] { body_->g2p2g(executor, data, blocks, KernelType::compact); };
    pass();  // takes memory for the first time
    const Executed found = executed_instructions(pass);
    EXPECT_EQ(scene_.results[0].fault, FaultCode::none);
    return found;
  }
  int fields() const { return body_->store().fields(); }

 private:
  using Scene = BlockScene<3, T>;

  static std::unique_ptr<Body<3, T>> make(const char* model) {
    BodyInfo info;
    info.model = model;
    info.density = 1700;
    info.particle_volume = 0.1;
    return make_body<3, T>(info, typical_input(*find_material_model(model), 3));
  }

  std::unique_ptr<Body<3, T>> body_;
  Scene scene_;
};

template <class T>
void expect_lean_pass(const char* model, double known) {
  constexpr int few = 64, more = 128, line = 64 / int(sizeof(T));
  Pass<T> small(model, few), large(model, more);
  const Executed a = small.over_blocks(1), b = large.over_blocks(1), twice = small.over_blocks(2);
  const double instructions = double(b.instructions - a.instructions) / (more - few);
  const double prefetches = double(b.prefetches - a.prefetches) / (more - few);
  const double particles = double(few) / line * small.fields();  // lines of all particles
  const double written = double(a.prefetches) - particles;
  const double read = double(twice.prefetches - 2 * a.prefetches);
  std::printf("%s, %s: %.0f instructions and %.2f prefetches a particle, %.0f + %.0f a block\n",
              model, sizeof(T) == 4 ? "single" : "double", instructions, prefetches, written, read);
  // Every line of every field. (A quarter less: the nodes are fetched in runs, whose number may
  // change a little with that of the batches.)
  EXPECT_GE(prefetches, 0.75 * small.fields() / line);
  // The nodes that are written to, and those to read of a block that is looked ahead to: 2 x 6^3
  // nodes of four numbers. (`written` misses some: the first particles are not fetched ahead.)
  constexpr double nodes = 2 * 216 * 4.0 / line;
  EXPECT_GE(written, nodes);
  EXPECT_GE(read, nodes);
  EXPECT_LE(instructions, 1.1 * known);  // for other tunings and releases of the compiler
}

void expect_lean_passes(const char* model, const Figures& known) {
  if (!excuse().empty()) GTEST_SKIP() << excuse();
  if (find_material_model(model) == nullptr) GTEST_SKIP() << "a build without this law";
  expect_lean_pass<float>(model, known.single);
  expect_lean_pass<double>(model, known.twice);
}

#if defined(__linux__) && defined(__x86_64__) && defined(__GNUC__)
TEST(Instructions, are_counted_one_by_one) {
  if (!can_count_instructions()) GTEST_SKIP() << "no way to step through a program here";
  const Executed none = executed_instructions([] {});
  const Executed some = executed_instructions([] {
    asm volatile(
        ".rept 100\n\tnop\n\t.endr\n\t"
        "prefetcht0 (%%rsp)\n\tprefetchnta (%%r8)\n\tprefetchw (%%rsp)\n\t" ::
            : "memory");
  });
  EXPECT_EQ(none.prefetches, 0);
  EXPECT_EQ(some.prefetches, 3);
  EXPECT_EQ(some.instructions - none.instructions, 103);
}
#endif

TEST(Instructions, of_the_fused_pass_of_elastic_bodies) {
  expect_lean_passes("fixed_corotated", figures({345, 635}, {161, 333}));
}

TEST(Instructions, of_the_fused_pass_of_sand) {
  expect_lean_passes("drucker_prager", figures({431, 812}, {205, 424}));
}

}  // namespace
}  // namespace scree::testing

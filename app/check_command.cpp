// SPDX-License-Identifier: Apache-2.0
#include "app/check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "app/build_simulation.hpp"
#include "app/coupling_report.hpp"
#include "app/deck_warnings.hpp"
#include "app/machine_info.hpp"
#include "app/sampler.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/deck.hpp"
#include "solver/particles/shape.hpp"
#include "solver/simulation/lone_particle.hpp"

namespace scree {
namespace {

/// Bytes that this machine can still give, from /proc/meminfo; infinite where that is not there.
double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  double kibibytes = 0;
  while (file >> name >> kibibytes) {
    std::getline(file, unit);
    if (name == "MemAvailable:") return 1024 * kibibytes;
  }
  return std::numeric_limits<double>::infinity();
}

/// Particles if every body filled its bounds: never less than there are.
double particle_bound(const Deck& deck) {
  double total = 0;
  for (const BodySpec& body : deck.bodies) {
    const Box box = make_shape(body.shape, deck.domain.dimension)->bounds();
    double count = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(deck.domain.dimension); ++a) {
      const double spacing = deck.domain.cell_size / body.particles_per_direction;
      count *= std::max(1.0, (box.upper[a] - box.lower[a]) / spacing);
    }
    total += count;
  }
  return total;
}

std::string bytes_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.1f} MB", bytes / 1e6);
  return fmt::format("{:.2f} GB", bytes / 1e9);
}

std::string duration_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 172800) return fmt::format("{:.1f} h", seconds / 3600);
  const double years = seconds / (365.25 * 86400);
  if (years < 2) return fmt::format("{:.1f} days", seconds / 86400);
  return fmt::format("{:.3g} years", years);
}

/// A whole number; beyond 1e12 only its size, not hundreds of digits.
std::string count_text(double x) {
  return x < 1e12 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

/// To three digits.
double rounded(double x) {
  if (!std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(x)) - 2));
  return unit * std::round(x / unit);
}

void line(const std::string& name, const std::string& value) {
  fmt::print("{:<16} {}\n", name, value);
}

/// Seconds a step, from some steps that are thrown away; at most about a second of work.
struct Measurement {
  double seconds_per_step = 0;
  double dt = 0;  ///< mean step, s
  int steps = 0;
  std::string fault;
};

Measurement measure(Simulation& simulation, double end) {
  using Clock = std::chrono::steady_clock;
  constexpr int most_steps = 200, warm_up = 1;
  constexpr double most_seconds = 1;
  Measurement result;
  auto start = Clock::now();
  double begin = 0;
  try {
    for (int i = 0; i < most_steps + warm_up && simulation.time() < end; ++i) {
      if (i == warm_up) {
        start = Clock::now();
        begin = simulation.time();
      }
      simulation.step();
      if (i < warm_up) continue;
      ++result.steps;
      const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
      result.seconds_per_step = elapsed / result.steps;
      result.dt = (simulation.time() - begin) / result.steps;
      if (elapsed > most_seconds) break;
    }
  } catch (const RunFault& fault) {
    result.fault = fault.what();
  }
  return result;
}

std::string particles_text(const SimulationSetup& setup) {
  std::size_t total = 0;
  std::string bodies;
  for (const BodySetup& body : setup.bodies) {
    const std::size_t count = body.position.size() / 3;
    total += count;
    bodies += fmt::format("{}{} {}", bodies.empty() ? "" : ", ", body.name, count);
  }
  return fmt::format("{} ({})", total, bodies);
}

/// What is printed about a deck that fits into memory.
struct Prediction {
  std::string particles, masses;
  std::vector<std::string> warnings;
  int threads = 1;
  std::size_t blocks = 0;
  double first_step = 0;  ///< s
  double courant = 0;     ///< of the automatic step
  double bytes = 0;
  Measurement measured;
};

Prediction predict(const Deck& deck, int threads) {
  SimulationSetup setup = build_setup(deck);
  setup.threads = threads;
  Prediction result;
  result.threads = threads;
  result.particles = particles_text(setup);
  result.masses = masses_text(deck, setup);
  result.warnings = deck_warnings(deck, setup);
  result.courant = courant_number(setup);
  const auto simulation = Simulation::create(std::move(setup));
  check_probes(deck, simulation->particle_count());
  result.blocks = static_cast<std::size_t>(simulation->block_count());
  result.first_step = simulation->dt();
  result.bytes = static_cast<double>(simulation->memory().total());
  result.measured = measure(*simulation, deck.time.end);
  return result;
}

void print_effort(const Deck& deck, const Prediction& prediction) {
  const Measurement& measured = prediction.measured;
  // Steps shortened to hit output times make the mean a little less than the first.
  const double mean = measured.steps > 0 ? measured.dt : prediction.first_step;
  const double steps = std::ceil(deck.time.end / mean);
  line("steps", fmt::format("about {} to {:.6g} s", count_text(rounded(steps)), deck.time.end));
  const double frames = deck.output.format == FrameFormat::none
                            ? 0
                            : double(build_schedule(deck).count(Schedule::frame_stream));
  line("frames", count_text(frames));
  if (!measured.fault.empty() || measured.steps == 0) return;
  line("estimated time", fmt::format("about {} with {} threads (from {} steps on this machine)",
                                     duration_text(steps * measured.seconds_per_step),
                                     prediction.threads, measured.steps));
}

std::string first_step_text(const Deck& deck, const Prediction& prediction) {
  std::string text = fmt::format("{:.4g} s", prediction.first_step);
  if (deck.time.step) return text + " (fixed)";
  if (prediction.courant >= deck.time.cfl) return text;
  return text + fmt::format(" (cfl {:.3g} in place of {:.3g}, or drops of fluid would come apart)",
                            prediction.courant, deck.time.cfl);
}

void print(const Deck& deck, const Prediction& prediction) {
  line("particles", prediction.particles);
  line("mass", prediction.masses);
  line("blocks", fmt::format("{} of 4^{} cells", prediction.blocks, deck.domain.dimension));
  line("first step", first_step_text(deck, prediction));
  for (const std::string& water : coupling_report(deck)) line("pore water", water);
  line("memory", fmt::format("about {}", bytes_text(prediction.bytes)));
  print_effort(deck, prediction);
  for (const std::string& warning : prediction.warnings) line("warning", warning);
}

}  // namespace

int check_command(const CheckOptions& options) {
  Problems problems;
  const Deck deck = read_deck(options.deck, options.overrides, problems);
  if (!problems.empty()) {
    fmt::print(stderr, "{}", problems.text());
    return 2;
  }
  // A simulation takes less than this a particle, grid and margins included.
  constexpr double bytes_per_particle = 600;
  const double bound = particle_bound(deck);
  const bool fits = bound * bytes_per_particle < 0.8 * available_memory();
  if (!fits) {
    fmt::print("{}: valid\n", options.deck);
    line("particles", fmt::format("up to {:.3g}", bound));
    line("memory", fmt::format("up to {}, more than this machine has free",
                               bytes_text(bound * bytes_per_particle)));
    return 0;
  }
  const Prediction prediction = predict(deck, thread_count(options.threads));
  const std::string& fault = prediction.measured.fault;
  if (fault.empty()) fmt::print("{}: valid\n", options.deck);
  print(deck, prediction);
  if (fault.empty()) return 0;
  std::fflush(stdout);
  fmt::print(stderr, "scree: {}: the first steps fail: {}\n", options.deck, fault);
  return 1;
}

}  // namespace scree

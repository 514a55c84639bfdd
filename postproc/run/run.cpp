// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "solver/base/error.hpp"
#include "solver/deck/document.hpp"
#include "solver/deck/expression.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

const Value* find_path(const Value& table, const std::string& section, const std::string& key) {
  const Value* found = table.find(section);
  return found == nullptr ? nullptr : found->find(key);
}

/// A number of the resolved deck, which is SI throughout.
std::optional<double> number_at(const Value& deck, const std::string& section,
                                const std::string& key) {
  const Value* value = find_path(deck, section, key);
  if (value == nullptr || !value->is_number()) return std::nullopt;
  return value->number();
}

}  // namespace

Run::Run(const fs::path& folder) : folder_(folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw UserError("there is no run folder " + folder.string());
  }
  const fs::path resolved = folder / "resolved.toml";
  if (!fs::exists(resolved, ignored)) {
    throw UserError(folder.string() + " is not the folder of a run: it has no resolved.toml");
  }
  Problems problems;
  std::optional<Value> deck = read_document(resolved.string(), problems);
  if (!deck) throw UserError("the run's deck cannot be read: " + problems.text());
  deck_ = std::move(*deck);
  read_domain();
  read_bodies();
  read_gravity();
}

std::string Run::title() const {
  const Value* title = deck_.find("title");
  if (title != nullptr && !title->text.empty()) return title->text;
  return fs::absolute(folder_).lexically_normal().filename().string();
}

std::string Run::status() const {
  std::ifstream in(folder_ / "run.json");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("status") || !json["status"].is_string()) {
    return "unknown";
  }
  return json["status"].get<std::string>();
}

void Run::read_domain() {
  const auto missing = [&](const std::string& key) {
    return UserError((folder_ / "resolved.toml").string() + " has no domain." + key);
  };
  const auto dimension = number_at(deck_, "domain", "dimension");
  if (!dimension) throw missing("dimension");
  dimension_ = static_cast<int>(*dimension);
  const auto cell = number_at(deck_, "domain", "cell_size");
  if (!cell) throw missing("cell_size");
  cell_size_ = *cell;
  for (auto [key, target] : {std::pair{"lower", &lower_}, std::pair{"upper", &upper_}}) {
    const Value* corner = find_path(deck_, "domain", key);
    if (corner == nullptr || corner->items.size() < static_cast<std::size_t>(dimension_)) {
      throw missing(key);
    }
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
      (*target)[a] = corner->items[a].number();
    }
  }
}

void Run::read_bodies() {
  const Value* bodies = deck_.find("body");
  if (bodies == nullptr) return;
  for (const Value& item : bodies->items) {
    const Value* per_direction = item.find("particles_per_direction");
    const double count = per_direction != nullptr ? per_direction->number() : 2;
    RunBody body;
    body.name = item.key;
    body.particle_spacing = cell_size_ / count;
    body.particle_volume = std::pow(body.particle_spacing, dimension_);
    bodies_.push_back(body);
  }
}

void Run::read_gravity() {
  up_ = {dimension_ == 2 ? 1 : 2, 1};
  const Value* gravity = find_path(deck_, "method", "gravity");
  if (gravity == nullptr) return;
  for (std::size_t a = 0; a < gravity->items.size() && a < 3; ++a) {
    const Value& item = gravity->items[a];
    gravity_[a] = item.is_number() ? toml_number(item.number()) : item.text;
  }
  // A gravity that grows from zero has its direction at the end.
  const double end = number_at(deck_, "time", "end").value_or(0);
  const std::array<double, 3> acting = this->gravity(end);
  double largest = 0;
  for (int a = 0; a < dimension_; ++a) {
    const double g = acting[static_cast<std::size_t>(a)];
    if (std::abs(g) <= largest) continue;
    largest = std::abs(g);
    up_ = {a, g < 0 ? 1 : -1};
  }
}

std::array<double, 3> Run::gravity(double time) const {
  std::array<double, 3> result{};
  for (std::size_t a = 0; a < 3; ++a) result[a] = Expression(gravity_[a], {"t"})(&time);
  return result;
}

const FrameSource& Run::frames() const {
  if (!frames_) frames_ = open_frames(folder_);
  return *frames_;
}

const std::vector<FieldInfo>& Run::fields() const {
  if (!fields_) fields_ = frames().fields(0);
  return *fields_;
}

WeightedFrame read_weighted(const Run& run, std::size_t frame, std::vector<std::string> fields) {
  const bool asked = std::find(fields.begin(), fields.end(), "volume") != fields.end();
  for (const FieldInfo& field : run.fields()) {
    if (field.name == "volume" && !asked) fields.push_back("volume");
  }
  WeightedFrame result;
  result.particles = run.frames().read(frame, fields);
  result.volume = particle_volumes(run, result.particles);
  return result;
}

std::vector<double> particle_volumes(const Run& run, const ParticleSnapshot& snapshot) {
  for (const SnapshotField& field : snapshot.fields) {
    if (field.name == "volume") return field.values;
  }
  std::vector<double> result;
  result.reserve(snapshot.id.size());
  for (const std::int32_t body : snapshot.body) {
    const auto index = static_cast<std::size_t>(body);
    if (index >= run.bodies().size()) {
      throw UserError("a particle belongs to body " + std::to_string(body) +
                      ", which the resolved deck does not have");
    }
    result.push_back(run.bodies()[index].particle_volume);
  }
  return result;
}

}  // namespace scree

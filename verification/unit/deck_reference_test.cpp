// SPDX-License-Identifier: Apache-2.0
// What `scree describe` prints: complete, valid, and the same as docs/deck.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/reference.hpp"
#include "materials/registry.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

TEST(Reference, HasEveryTableOnceAndEveryModel) {
  const Reference reference;
  const auto topics = reference.topics();
  for (const char* topic : {"deck", "domain", "time", "method", "damping", "material", "body",
                            "shape", "initial_stress", "traction", "boundary", "face", "collider",
                            "contact", "output", "history", "checkpoint"}) {
    EXPECT_EQ(std::count(topics.begin(), topics.end(), topic), 1) << topic;
  }
  for (const MaterialEntry& model : material_registry()) {
    EXPECT_EQ(std::count(topics.begin(), topics.end(), model.name), 1) << model.name;
  }
}

TEST(Reference, FindsSchemasAndKeys) {
  const Reference reference;
  ASSERT_EQ(reference.find("drucker_prager").size(), 1u);
  EXPECT_EQ(reference.find("drucker_prager")[0]->schema->name(), "drucker_prager");
  EXPECT_EQ(reference.find("time.cfl")[0]->schema->name(), "time");
  EXPECT_GE(reference.find("velocity").size(), 2u);  // of bodies and colliders
  EXPECT_TRUE(reference.find("no_such_topic").empty());
}

TEST(Reference, EveryKeyIsDocumented) {
  const Reference reference;
  for (const ReferenceSection& section : reference.sections()) {
    EXPECT_NE(section.schema->doc(), "") << section.schema->name();
    for (const auto& entry : section.schema->entries()) {
      const std::string name = section.schema->name() + "." + entry->key;
      EXPECT_NE(entry->doc, "") << name;
      EXPECT_TRUE(entry->required || !entry->fallback_text.empty() ||
                  entry->kind == EntryKind::text)
          << name;
    }
  }
}

TEST(Reference, TextFitsATerminalAndHasEveryKey) {
  const Reference reference;
  const std::string text = reference_text(reference, "");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
  }
  for (const ReferenceSection& section : reference.sections()) {
    for (const auto& entry : section.schema->entries()) {
      EXPECT_NE(text.find("\n  " + entry->key + "\n"), std::string::npos) << entry->key;
    }
  }
}

TEST(Reference, TopicPrintsOnlyItself) {
  const Reference reference;
  const std::string text = reference_text(reference, "time");
  EXPECT_NE(text.find("  cfl\n      number, above 0 and at most 0.5; default: 0.4\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("gravity"), std::string::npos) << text;
}

/// All that may stand in a material's table, with the limits that other keys set.
TEST(Reference, ModelsHaveTheKeysOfEveryMaterial) {
  const Reference reference;
  const std::string sand = reference_text(reference, "drucker_prager");
  EXPECT_NE(sand.find("\n  undrained_bulk_modulus\n      number [Pa], above 0 Pa; default: no pore "
                      "water\n"),
            std::string::npos)
      << sand;
  EXPECT_NE(sand.find("\n  density\n"), std::string::npos) << sand;
  EXPECT_NE(
      sand.find("\n  friction_angle\n      number [rad, or \"... deg\"], above 0 deg and below "
                "90 deg"),
      std::string::npos)
      << sand;
  EXPECT_NE(sand.find("at most friction_angle"), std::string::npos) << sand;
  const std::string fluid = reference_text(reference, "j_fluid");
  EXPECT_EQ(fluid.find("undrained_bulk_modulus"), std::string::npos) << fluid;
  EXPECT_NE(reference_markdown(reference, "hencky").find("| `undrained_bulk_modulus` | "),
            std::string::npos);
}

TEST(Reference, MarkdownTablesAreWhole) {
  const Reference reference;
  std::istringstream lines(reference_markdown(reference, ""));
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    ++rows;
    // Bars that end cells; those in the text are escaped.
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
    }
    EXPECT_EQ(bars, 5) << line;
  }
  EXPECT_GT(rows, 60);
}

TEST(Reference, DocumentationIsUpToDate) {
  std::ifstream file(SCREE_SOURCE_DIR "/docs/deck.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == reference_markdown(Reference(), ""))
      << "docs/deck.md is stale; run: build/bin/scree describe --markdown > docs/deck.md";
}

/// Calls `visit` for every object inside.
void walk(const Json& json, const std::function<void(const Json&)>& visit) {
  if (json.is_object()) visit(json);
  for (const auto& item : json.items()) {
    if (item.value().is_structured()) walk(item.value(), visit);
  }
}

TEST(JsonSchema, IsDraft202012AndItsReferencesLead) {
  const Json schema = Json::parse(reference_json_schema(Reference()));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  walk(schema, [&](const Json& object) {
    if (!object.contains("$ref") || !object["$ref"].is_string()) return;
    const std::string target = object["$ref"];
    ASSERT_EQ(target.rfind("#/$defs/", 0), 0u) << target;
    EXPECT_TRUE(schema["$defs"].contains(target.substr(8))) << target;
  });
}

TEST(JsonSchema, HasEveryKeyOfEveryTable) {
  const Json schema = Json::parse(reference_json_schema(Reference()));
  const Reference reference;
  for (const ReferenceSection& section : reference.sections()) {
    const std::string name = section.schema->name();
    if (name == "material") continue;  // part of every model
    const Json& table = name == "deck" ? schema : schema["$defs"][name];
    const Json& object = table.contains("anyOf") ? table["anyOf"][0] : table;
    EXPECT_EQ(object["type"], "object") << name;
    EXPECT_EQ(object["additionalProperties"], false) << name;
    for (const std::string& key : section.schema->keys()) {
      EXPECT_TRUE(object["properties"].contains(key)) << name << "." << key;
    }
  }
  for (const MaterialEntry& model : material_registry()) {
    const Json& properties = schema["$defs"][model.name]["properties"];
    EXPECT_TRUE(properties.contains("density"));
    EXPECT_EQ(properties["model"]["const"], model.name);
  }
}

}  // namespace
}  // namespace scree

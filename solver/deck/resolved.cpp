// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/deck.hpp"

/// The resolved echo: a deck written from the specs, through the same schemas that read it.
namespace scree {
namespace {

std::string child_path(const std::string& path, const std::string& key) {
  return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

class Writer {
 public:
  explicit Writer(const Deck& deck) : deck_(deck), dimension_(deck.domain.dimension) {}

  std::string text() {
    text_ =
        "# Every value that the run used. \"# default\" marks those that the deck did not give.\n";
    // Keys of the top level stand before the first table.
    for (const auto& entry : deck_schema().entries()) {
      if (entry->kind != EntryKind::table && entry->kind != EntryKind::named) {
        line(*entry, &deck_, "", "");
      }
    }
    for (const auto& entry : deck_schema().entries()) {
      const void* member = entry->member(const_cast<Deck*>(&deck_));
      if (entry->kind == EntryKind::table) {
        const std::string& path = entry->key;
        entry->visit(member, [&](const std::string&, const SchemaBase& schema, const void* item) {
          header(path);
          table(schema, item, path, "");
        });
      } else if (entry->kind == EntryKind::named) {
        named(*entry, member);
      }
    }
    return text_;
  }

 private:
  void header(const std::string& path) { text_ += "\n[" + path + "]\n"; }

  void named(const Entry& entry, const void* member) {
    std::string last;
    entry.visit(member, [&](const std::string& name, const SchemaBase& schema, const void* item) {
      // A material is visited twice: common keys, then those of its model.
      const std::string path = child_path(entry.key, name);
      if (path != last) header(path);
      last = path;
      table(schema, item, path, "");
    });
  }

  bool available(const SchemaBase& schema, const Entry& entry, const void* spec) const {
    if (entry.dimension != 0 && entry.dimension != dimension_) return false;
    if (entry.tag.empty()) return true;
    const Entry& tag = *schema.find(entry.tag);
    const std::string value = tag.write(tag.member(const_cast<void*>(spec)), dimension_);
    for (const std::string& allowed : entry.tag_values) {
      if (value == toml_string(allowed)) return true;
    }
    return false;
  }

  /// The entries of a spec; nested tables as dotted keys.
  void table(const SchemaBase& schema, const void* spec, const std::string& path,
             const std::string& prefix) {
    for (const auto& entry : schema.entries()) {
      if (!available(schema, *entry, spec)) continue;
      // A fixed step excludes cfl.
      if (path == "time" && entry->key == "cfl" && deck_.time.step) continue;
      if (entry->kind != EntryKind::table) {
        line(*entry, spec, path, prefix);
        continue;
      }
      entry->visit(entry->member(const_cast<void*>(spec)),
                   [&](const std::string&, const SchemaBase& nested, const void* item) {
                     table(nested, item, child_path(path, entry->key),
                           prefix + toml_key(entry->key) + ".");
                   });
    }
  }

  void line(const Entry& entry, const void* spec, const std::string& path,
            const std::string& prefix) {
    const std::string value = value_text(entry, spec);
    if (value.empty()) return;
    text_ += prefix + toml_key(entry.key) + " = " + value;
    if (!deck_.given.contains(child_path(path, entry.key))) text_ += "  # default";
    text_ += "\n";
  }

  std::string value_text(const Entry& entry, const void* spec) {
    const void* member = entry.member(const_cast<void*>(spec));
    if (entry.kind == EntryKind::list) return list_text(entry, member);
    if (entry.kind == EntryKind::table) return table_text(entry, member);
    return entry.write(member, dimension_);
  }

  /// A table in a table of a list; "" if it is not set.
  std::string table_text(const Entry& entry, const void* member) {
    std::string text;
    entry.visit(member, [&](const std::string&, const SchemaBase& schema, const void* item) {
      text = inline_table(schema, item);
    });
    return text;
  }

  std::string list_text(const Entry& entry, const void* member) {
    std::string items;
    entry.visit(member, [&](const std::string&, const SchemaBase& schema, const void* item) {
      items += (items.empty() ? "" : ", ") + inline_table(schema, item);
    });
    return items.empty() ? items : "[" + items + "]";
  }

  std::string inline_table(const SchemaBase& schema, const void* spec) {
    std::string members;
    for (const auto& entry : schema.entries()) {
      if (!available(schema, *entry, spec)) continue;
      const std::string value = value_text(*entry, spec);
      if (value.empty()) continue;
      members += (members.empty() ? "" : ", ") + toml_key(entry->key) + " = " + value;
    }
    return "{ " + members + " }";
  }

  const Deck& deck_;
  int dimension_;
  std::string text_;
};

}  // namespace

std::string resolved_toml(const Deck& deck) { return Writer(deck).text(); }

}  // namespace scree

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/schema.hpp"

/// How each kind of entry reads, writes and visits its member (included by schema.hpp).
namespace scree {

template <class S>
Field<double> Schema<S>::number(std::string key, double S::*member, Unit unit) {
  Entry& e = bind(std::move(key), EntryKind::number, unit, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.number(e, value, path, *static_cast<double*>(m));
  };
  e.write = [](const void* m, int) { return write_number(*static_cast<const double*>(m)); };
  return Field<double>(e);
}

template <class S>
Field<std::optional<double>> Schema<S>::number(std::string key, std::optional<double> S::*member,
                                               Unit unit) {
  Entry& e = bind(std::move(key), EntryKind::number, unit, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    double number = 0;
    if (reader.number(e, value, path, number)) *static_cast<std::optional<double>*>(m) = number;
  };
  e.write = [](const void* m, int) {
    const auto& number = *static_cast<const std::optional<double>*>(m);
    return number ? write_number(*number) : std::string();
  };
  e.required = false;
  e.fallback_text = "not set";
  return Field<std::optional<double>>(e);
}

template <class S>
Field<int> Schema<S>::integer(std::string key, int S::*member) {
  Entry& e = bind(std::move(key), EntryKind::integer, Unit::none, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.integer(e, value, path, *static_cast<int*>(m));
  };
  e.write = [](const void* m, int) { return std::to_string(*static_cast<const int*>(m)); };
  return Field<int>(e);
}

template <class S>
Field<bool> Schema<S>::flag(std::string key, bool S::*member) {
  Entry& e = bind(std::move(key), EntryKind::flag, Unit::none, member);
  e.read = [](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.flag(value, path, *static_cast<bool*>(m));
  };
  e.write = [](const void* m, int) {
    return std::string(*static_cast<const bool*>(m) ? "true" : "false");
  };
  return Field<bool>(e);
}

template <class S>
Field<std::string> Schema<S>::text(std::string key, std::string S::*member) {
  Entry& e = bind(std::move(key), EntryKind::text, Unit::none, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    const bool named = e.choices.empty() || reader.choice(e, value, path) >= 0;
    if (named) reader.text(value, path, *static_cast<std::string*>(m));
  };
  e.write = [](const void* m, int) { return toml_string(*static_cast<const std::string*>(m)); };
  return Field<std::string>(e);
}

template <class S>
Field<std::vector<std::string>> Schema<S>::texts(std::string key,
                                                 std::vector<std::string> S::*member) {
  using Texts = std::vector<std::string>;
  Entry& e = bind(std::move(key), EntryKind::texts, Unit::none, member);
  e.read = [](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.texts(value, path, *static_cast<Texts*>(m));
  };
  e.write = [](const void* m, int) { return write_texts(*static_cast<const Texts*>(m)); };
  return Field<Texts>(e);
}

template <class S>
template <class E>
Field<E> Schema<S>::choice(std::string key, E S::*member,
                           std::type_identity_t<std::vector<std::pair<std::string, E>>> names) {
  Entry& e = bind(std::move(key), EntryKind::choice, Unit::none, member);
  for (const auto& name : names) e.choices.push_back(name.first);
  e.read = [&e, names](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    const int index = reader.choice(e, value, path);
    if (index >= 0) *static_cast<E*>(m) = names[static_cast<std::size_t>(index)].second;
  };
  e.write = [names](const void* m, int) {
    for (const auto& name : names) {
      if (name.second == *static_cast<const E*>(m)) return toml_string(name.first);
    }
    return std::string();
  };
  return Field<E>(e);
}

template <class S>
template <class M>
auto Schema<S>::vector(std::string key, M S::*member, Unit unit) -> Field<Point> {
  static_assert(sizeof(M) == sizeof(Point), "a vector entry fills three doubles");
  Entry& e = bind(std::move(key), EntryKind::vector, unit, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.vector(e, value, path, static_cast<double*>(m));
  };
  e.write = [&e](const void* m, int dimension) {
    return write_vector(e, static_cast<const double*>(m), dimension);
  };
  return Field<Point>(e);
}

template <class S>
Field<Formula> Schema<S>::formula(std::string key, Formula S::*member, Unit unit,
                                  std::vector<std::string> variables) {
  Entry& e = bind(std::move(key), EntryKind::formula, unit, member);
  e.variables = std::move(variables);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.formula(e, value, path, *static_cast<Formula*>(m));
  };
  e.write = [](const void* m, int) { return write_formula(*static_cast<const Formula*>(m)); };
  return Field<Formula>(e);
}

template <class S>
Field<std::array<Formula, 3>> Schema<S>::formulas(std::string key,
                                                  std::array<Formula, 3> S::*member, Unit unit,
                                                  std::vector<std::string> variables) {
  using Formulas = std::array<Formula, 3>;
  Entry& e = bind(std::move(key), EntryKind::formulas, unit, member);
  e.variables = std::move(variables);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.formulas(e, value, path, static_cast<Formulas*>(m)->data());
  };
  e.write = [&e](const void* m, int dimension) {
    return write_formulas(e, static_cast<const Formulas*>(m)->data(), dimension);
  };
  return Field<Formulas>(e);
}

template <class S>
Field<std::vector<std::array<double, 2>>> Schema<S>::points(
    std::string key, std::vector<std::array<double, 2>> S::*member) {
  using Points = std::vector<std::array<double, 2>>;
  Entry& e = bind(std::move(key), EntryKind::points, Unit::length, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.points(e, value, path, *static_cast<Points*>(m));
  };
  e.write = [](const void* m, int) { return write_points(*static_cast<const Points*>(m)); };
  return Field<Points>(e);
}

template <class S>
Field<std::array<double, 9>> Schema<S>::matrix(std::string key, std::array<double, 9> S::*member) {
  using Matrix = std::array<double, 9>;
  Entry& e = bind(std::move(key), EntryKind::matrix, Unit::none, member);
  e.read = [&e](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.matrix(e, value, path, *static_cast<Matrix*>(m));
  };
  e.write = [](const void* m, int) { return write_matrix(*static_cast<const Matrix*>(m)); };
  return Field<Matrix>(e);
}

template <class S>
template <class N>
Field<N> Schema<S>::table(std::string key, N S::*member, const Schema<N>& (*schema)()) {
  Entry& e = bind(std::move(key), EntryKind::table, Unit::none, member);
  e.nested = [schema]() -> const SchemaBase& { return schema(); };
  e.reset = [schema](void* m, const SchemaContext& context) { schema().reset(m, context); };
  e.read = [schema](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.read(schema(), m, value, path);
  };
  e.write = [](const void*, int) { return std::string(); };
  e.visit = [schema](const void* m, const Entry::Visitor& visitor) { visitor("", schema(), m); };
  return Field<N>(e);
}

template <class S>
template <class N>
Field<std::optional<N>> Schema<S>::table(std::string key, std::optional<N> S::*member,
                                         const Schema<N>& (*schema)()) {
  Entry& e = bind(std::move(key), EntryKind::table, Unit::none, member);
  e.required = false;
  e.fallback_text = "not set";
  e.nested = [schema]() -> const SchemaBase& { return schema(); };
  e.read = [schema](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    reader.read(schema(), &static_cast<std::optional<N>*>(m)->emplace(), value, path);
  };
  e.write = [](const void*, int) { return std::string(); };
  e.visit = [schema](const void* m, const Entry::Visitor& visitor) {
    const auto& item = *static_cast<const std::optional<N>*>(m);
    if (item) visitor("", schema(), &*item);
  };
  return Field<std::optional<N>>(e);
}

template <class S>
template <class N>
Field<std::vector<N>> Schema<S>::list(std::string key, std::vector<N> S::*member,
                                      const Schema<N>& (*schema)()) {
  Entry& e = bind(std::move(key), EntryKind::list, Unit::none, member);
  e.nested = [schema]() -> const SchemaBase& { return schema(); };
  e.read = [schema](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    if (!value.is(Value::Kind::array) || value.items.empty()) {
      reader.report(value, path, "must be an array of tables");
      return;
    }
    auto& items = *static_cast<std::vector<N>*>(m);
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      const std::string item_path = path + "[" + std::to_string(i) + "]";
      reader.read(schema(), &items.emplace_back(), value.items[i], item_path);
    }
  };
  e.write = [](const void*, int) { return std::string(); };
  e.visit = [schema](const void* m, const Entry::Visitor& visitor) {
    for (const N& item : *static_cast<const std::vector<N>*>(m)) visitor("", schema(), &item);
  };
  return Field<std::vector<N>>(e);
}

template <class S>
template <class N>
Field<std::vector<N>> Schema<S>::named(std::string key, std::vector<N> S::*member,
                                       const Schema<N>& (*schema)()) {
  Entry& e = bind(std::move(key), EntryKind::named, Unit::none, member);
  e.nested = [schema]() -> const SchemaBase& { return schema(); };
  e.read = [schema](void* m, const Value& value, const std::string& path, SchemaReader& reader) {
    for (const Value* item : reader.named_tables(value, path)) {
      N& spec = static_cast<std::vector<N>*>(m)->emplace_back();
      reader.read(schema(), &spec, *item, path + "." + toml_key(item->key));
      spec.name = item->key;
    }
  };
  e.write = [](const void*, int) { return std::string(); };
  e.visit = [schema](const void* m, const Entry::Visitor& visitor) {
    for (const N& item : *static_cast<const std::vector<N>*>(m)) {
      visitor(item.name, schema(), &item);
    }
  };
  return Field<std::vector<N>>(e);
}

}  // namespace scree

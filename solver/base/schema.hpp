// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/units.hpp"
#include "solver/base/value.hpp"

/// Schemas: what a deck may say, declared next to the code that uses it. From one declaration come
/// reading with errors, defaults, the resolved echo, the reference text and the JSON schema.
namespace scree {

class SchemaBase;
class SchemaReader;

/// What checks and defaults may depend on.
struct SchemaContext {
  int dimension = 3;               ///< domain.dimension; 0: not known (it is faulty)
  std::string kernel = "compact";  ///< method.kernel
  /// What is wrong with an expression of these variables, or nothing. Not checked when empty.
  std::function<std::optional<std::string>(const std::string& text,
                                           const std::vector<std::string>& variables)>
      formula_fault;
};

/// The result of a cross check that failed; `key` is relative to the table of the schema.
struct Finding {
  std::string key, message, allowed, repair;
};

/// A number or an expression, as text in SI ("-9.81", "-9.81*min(t/2,1)"); empty: not given.
struct Formula {
  std::string text;
  bool given() const { return !text.empty(); }
  bool operator==(const Formula&) const = default;
};

enum class EntryKind {
  number,
  integer,
  flag,
  text,
  texts,
  choice,
  vector,
  formula,
  formulas,
  points,
  matrix,
  table,  ///< one nested table
  list,   ///< an array of nested tables
  named   ///< tables under names chosen by the user: [body.NAME]
};

/// One key: its description, and type-erased operations on the member it fills.
struct Entry {
  std::string key, doc;
  EntryKind kind = EntryKind::number;
  Unit unit = Unit::none;
  bool required = true;
  std::string fallback_text;           ///< the default as the reference prints it
  std::optional<double> lower, upper;  ///< range of numbers, integers and vector entries
  bool lower_open = false, upper_open = false;
  std::optional<double> typical;            ///< of a number, SI: what benchmarks and tests use
  int length = 0;                           ///< entries of a vector; 0: domain.dimension
  int dimension = 0;                        ///< only available with this domain.dimension; 0: both
  std::vector<std::string> choices, later;  ///< allowed names; known names of later versions
  std::vector<std::string> variables;       ///< of expressions
  std::string tag;                          ///< only available when the key `tag` is one of...
  std::vector<std::string> tag_values;
  std::function<const SchemaBase&()> nested;
  /// For `named` whose schema depends on the key `tag` of each table: name and schema of each kind.
  std::function<std::vector<const SchemaBase*>()> variants;

  std::function<void*(void* spec)> member;
  std::function<void(void* member, const SchemaContext&)> reset;
  std::function<void(void* member, const Value&, const std::string& path, SchemaReader&)> read;
  /// TOML text of the value in a deck of this dimension, "" when it is not set.
  std::function<std::string(const void* member, int dimension)> write;
  using Visitor = std::function<void(const std::string& name, const SchemaBase&, const void* item)>;
  /// Visits the nested specs (table, list, named).
  std::function<void(const void* member, const Visitor&)> visit;
};

/// Reads documents through schemas: fills specs, collects problems, remembers which keys were
/// given.
class SchemaReader {
 public:
  SchemaReader(SchemaContext context, Problems& problems)
      : context_(std::move(context)), problems_(problems) {}

  const SchemaContext& context() const { return context_; }
  /// Dotted paths of all keys that the document gave.
  const std::set<std::string>& given() const { return given_; }
  std::size_t problem_count() const { return problems_.size(); }

  /// Fills `spec` from a table (or the schema's shorthand); false if a problem was found.
  /// Keys in `elsewhere` belong to another schema that reads the same table.
  bool read(const SchemaBase& schema, void* spec, const Value& table, const std::string& path,
            const std::vector<std::string>& elsewhere = {});

  void report(const Value& value, const std::string& path, std::string message,
              std::string allowed = {}, std::string repair = {});

  // Readers of single values; they report and return false when the value does not fit.
  bool number(const Entry&, const Value&, const std::string& path, double& result);
  bool integer(const Entry&, const Value&, const std::string& path, int& result);
  bool flag(const Value&, const std::string& path, bool& result);
  bool text(const Value&, const std::string& path, std::string& result);
  bool texts(const Value&, const std::string& path, std::vector<std::string>& result);
  /// The index of the chosen name in entry.choices, or -1.
  int choice(const Entry&, const Value&, const std::string& path);
  bool vector(const Entry&, const Value&, const std::string& path, double* result);
  bool formula(const Entry&, const Value&, const std::string& path, Formula& result);
  bool formulas(const Entry&, const Value&, const std::string& path, Formula* result);
  bool points(const Entry&, const Value&, const std::string& path,
              std::vector<std::array<double, 2>>& result);
  bool matrix(const Entry&, const Value&, const std::string& path, std::array<double, 9>& result);

  /// The members of a table of named tables; reports once when it holds anything else.
  std::vector<const Value*> named_tables(const Value& value, const std::string& path);

  /// Reports keys of `table` that are not in `known`.
  void unknown_keys(const Value& table, const std::string& path,
                    const std::vector<std::string>& known);

 private:
  struct Scope;
  bool read_entry(const Entry&, Scope&);
  bool available(const Entry&, Scope&);
  void report_missing(const Entry&, const Scope&);
  void check_keys(const Scope&, const std::vector<std::string>& elsewhere);
  void run_checks(const SchemaBase&, const Scope&, bool all_right);
  bool has_length(const Entry&, const Value&, const std::string& path, const std::string& what);
  bool quantity(const Entry&, const Value&, const std::string& path, Quantity& result);
  bool in_range(const Entry&, double value, const Value&, const std::string& path, bool has_unit);

  SchemaContext context_;
  Problems& problems_;
  std::set<std::string> given_;
};

/// The fluent end of a declaration: `s.number(...).above(0).fallback(1.0).doc("...")`.
template <class T>
class Field {
 public:
  explicit Field(Entry& entry) : entry_(&entry) {}

  Field& doc(std::string text) { return entry_->doc = std::move(text), *this; }
  Field& above(double x) { return entry_->lower = x, entry_->lower_open = true, *this; }
  Field& at_least(double x) { return entry_->lower = x, entry_->lower_open = false, *this; }
  Field& below(double x) { return entry_->upper = x, entry_->upper_open = true, *this; }
  Field& at_most(double x) { return entry_->upper = x, entry_->upper_open = false, *this; }
  /// An example in SI, for benchmarks and tests; it is not a default.
  Field& typical(double x) { return entry_->typical = x, *this; }
  /// The default.
  Field& fallback(T value) {
    entry_->required = false;
    entry_->fallback_text = entry_->write(&value, 3);
    entry_->reset = [value](void* member, const SchemaContext&) {
      *static_cast<T*>(member) = value;
    };
    return *this;
  }
  /// A default that depends on the context; `text` says how.
  Field& fallback_by(std::function<T(const SchemaContext&)> value, std::string text) {
    entry_->required = false;
    entry_->fallback_text = std::move(text);
    entry_->reset = [value](void* member, const SchemaContext& context) {
      *static_cast<T*>(member) = value(context);
    };
    return *this;
  }
  /// Not required; the member keeps its initial value, whose meaning `text` tells.
  Field& fallback_text(std::string text) {
    return entry_->required = false, entry_->fallback_text = std::move(text), *this;
  }
  Field& optional() { return fallback_text("not set"); }
  /// Only available when the key `tag`, declared before, has one of these values.
  Field& when(std::string tag, std::vector<std::string> values) {
    entry_->tag = std::move(tag);
    entry_->tag_values = std::move(values);
    return *this;
  }
  Field& in_dimension(int dimension) { return entry_->dimension = dimension, *this; }
  /// Number of entries of a vector where it is not domain.dimension.
  Field& length(int count) { return entry_->length = count, *this; }
  /// The names that a text may be.
  Field& one_of(std::vector<std::string> names) {
    return entry_->choices = std::move(names), *this;
  }
  /// Names that a later version will know: refused with a sentence that says so.
  Field& later(std::vector<std::string> names) { return entry_->later = std::move(names), *this; }

 private:
  Entry* entry_;
};

/// A schema without its C++ type.
class SchemaBase {
 public:
  struct Check {
    std::vector<std::string> keys;  ///< runs when these had no problem; empty: all of the table's
    std::function<std::optional<Finding>(const void*, const SchemaContext&)> test;
  };

  SchemaBase(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  const std::vector<std::string>& citations() const { return citations_; }
  const std::vector<std::shared_ptr<Entry>>& entries() const { return entries_; }
  const std::vector<Check>& checks() const { return checks_; }
  const Entry* find(const std::string& key) const;
  std::vector<std::string> keys() const;
  const std::string& text_shorthand() const { return text_shorthand_; }
  const std::string& number_shorthand() const { return number_shorthand_; }

  /// A publication that users of this should cite.
  void cite(std::string publication) { citations_.push_back(std::move(publication)); }
  /// Lets a bare text (number) stand for a table with only this key: `x_min = "slip"`.
  void shorthand_text(std::string key) { text_shorthand_ = std::move(key); }
  void shorthand_number(std::string key) { number_shorthand_ = std::move(key); }

  /// Sets all members that have defaults.
  void reset(void* spec, const SchemaContext& context) const;

 protected:
  Entry& add(std::string key, EntryKind kind, Unit unit);

  std::string name_, doc_;
  std::vector<std::string> citations_;
  std::vector<std::shared_ptr<Entry>> entries_;
  std::vector<Check> checks_;
  std::string text_shorthand_, number_shorthand_;
};

/// The keys of the spec S. Every entry is required unless it gets a default.
template <class S>
class Schema : public SchemaBase {
 public:
  using SchemaBase::SchemaBase;
  using Point = std::array<double, 3>;

  Field<double> number(std::string key, double S::*member, Unit unit = Unit::none);
  /// A number that may be absent; not required.
  Field<std::optional<double>> number(std::string key, std::optional<double> S::*member,
                                      Unit unit = Unit::none);
  Field<int> integer(std::string key, int S::*member);
  Field<bool> flag(std::string key, bool S::*member);
  Field<std::string> text(std::string key, std::string S::*member);
  Field<std::vector<std::string>> texts(std::string key, std::vector<std::string> S::*member);
  template <class E>
  Field<E> choice(std::string key, E S::*member,
                  std::type_identity_t<std::vector<std::pair<std::string, E>>> names);
  /// Three doubles in any aggregate (std::array, C array, Vec3<double>), filled with
  /// domain.dimension entries, the rest zero.
  template <class M>
  Field<Point> vector(std::string key, M S::*member, Unit unit = Unit::none);
  /// A number, or an expression of `variables`.
  Field<Formula> formula(std::string key, Formula S::*member, Unit unit,
                         std::vector<std::string> variables);
  Field<std::array<Formula, 3>> formulas(std::string key, std::array<Formula, 3> S::*member,
                                         Unit unit, std::vector<std::string> variables);
  /// Points of the plane, [m].
  Field<std::vector<std::array<double, 2>>> points(std::string key,
                                                   std::vector<std::array<double, 2>> S::*member);
  /// Three rows of three numbers, without a unit; row-major.
  Field<std::array<double, 9>> matrix(std::string key, std::array<double, 9> S::*member);

  /// A nested table; `schema` is a function, so that schemas may nest in themselves. Required
  /// unless .optional() follows, which gives the nested defaults.
  template <class N>
  Field<N> table(std::string key, N S::*member, const Schema<N>& (*schema)());
  template <class N>
  Field<std::optional<N>> table(std::string key, std::optional<N> S::*member,
                                const Schema<N>& (*schema)());
  /// An array of tables.
  template <class N>
  Field<std::vector<N>> list(std::string key, std::vector<N> S::*member,
                             const Schema<N>& (*schema)());
  /// Tables [key.NAME]; N has a member `name`.
  template <class N>
  Field<std::vector<N>> named(std::string key, std::vector<N> S::*member,
                              const Schema<N>& (*schema)());

  /// A check over several keys; runs only when every key of the table was read without problem.
  template <class F>
  void check(F test) {
    check({}, test);
  }
  /// The same for a check that needs only these keys to be right.
  template <class F>
  void check(std::vector<std::string> keys, F test) {
    checks_.push_back({std::move(keys), [test](const void* spec, const SchemaContext& context) {
                         return std::optional<Finding>(test(*static_cast<const S*>(spec), context));
                       }});
  }

 protected:
  /// An entry whose member is reached through `member`.
  template <class M>
  Entry& bind(std::string key, EntryKind kind, Unit unit, M S::*member) {
    Entry& entry = add(std::move(key), kind, unit);
    entry.member = [member](void* spec) -> void* { return &(static_cast<S*>(spec)->*member); };
    return entry;
  }
};

/// The range as a sentence: "above 0 and at most 0.5", "at least 0 Pa"; angles in degrees.
std::string range_text(const Entry& entry);

/// TOML text of members, as the resolved echo prints them; "" for NaN, absent or empty.
std::string write_number(double value);
std::string write_formula(const Formula& formula);
std::string write_texts(const std::vector<std::string>& texts);
std::string write_points(const std::vector<std::array<double, 2>>& points);
std::string write_matrix(const std::array<double, 9>& matrix);
/// `entry.length` or else `dimension` entries.
std::string write_vector(const Entry& entry, const double* values, int dimension);
std::string write_formulas(const Entry& entry, const Formula* formulas, int dimension);

}  // namespace scree

#include "solver/base/schema_fields.hpp"

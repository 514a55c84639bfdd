// SPDX-License-Identifier: Apache-2.0
#include "solver/base/schema.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/deck/document.hpp"

namespace scree {
namespace {

enum class Color { red, green };

struct Inner {
  std::string type = "a";
  double depth = NAN;
  double width = 5;
};

struct Spec {
  double length = NAN;
  double ratio = NAN;
  std::optional<double> extra;
  int count = 0;
  bool on = false;
  std::string label;
  std::vector<std::string> words;
  Color color = Color::red;
  double point[3] = {7, 7, 7};
  std::array<Formula, 3> velocity;
  Inner inner;
  std::vector<Inner> parts;
};

const Schema<Inner>& inner_schema() {
  static const Schema<Inner> schema = [] {
    Schema<Inner> s("inner", "Inner table.");
    s.shorthand_text("type");
    s.shorthand_number("depth");
    s.text("type", &Inner::type).one_of({"a", "b"}).later({"c"}).fallback("a");
    s.number("depth", &Inner::depth, Unit::length).when("type", {"a"}).fallback(1.0);
    s.number("width", &Inner::width, Unit::length).when("type", {"b"});
    return s;
  }();
  return schema;
}

const Schema<Spec>& spec_schema() {
  static const Schema<Spec> schema = [] {
    Schema<Spec> s("spec", "Everything.");
    s.number("length", &Spec::length, Unit::length).above(0).doc("Length.");
    s.number("ratio", &Spec::ratio).at_least(0).below(0.5).fallback(0.25);
    s.number("extra", &Spec::extra, Unit::time);
    s.integer("count", &Spec::count)
        .at_least(1)
        .at_most(9)
        .fallback_by([](const SchemaContext& context) { return context.dimension; },
                     "domain.dimension");
    s.flag("on", &Spec::on).fallback(true);
    s.text("label", &Spec::label).fallback("none");
    s.texts("words", &Spec::words).fallback({"x"});
    s.choice("color", &Spec::color, {{"red", Color::red}, {"green", Color::green}})
        .fallback(Color::green);
    s.vector("point", &Spec::point, Unit::length).optional();
    s.formulas("velocity", &Spec::velocity, Unit::velocity, {"t"}).optional();
    s.table("inner", &Spec::inner, &inner_schema).optional();
    s.list("parts", &Spec::parts, &inner_schema).optional();
    s.check({"ratio", "length"},
            [](const Spec& spec, const SchemaContext&) -> std::optional<Finding> {
              if (spec.ratio < spec.length) return std::nullopt;
              return Finding{"ratio", "is not below length", "less", "shrink it"};
            });
    return s;
  }();
  return schema;
}

struct Result {
  Spec spec;
  std::string text;
  std::set<std::string> given;
};

Result read(const std::string& toml, int dimension = 2) {
  Problems problems;
  const auto document = parse_document(toml, "f", problems);
  EXPECT_TRUE(document) << problems.text();
  SchemaContext context;
  context.dimension = dimension;
  SchemaReader reader(context, problems);
  Result result;
  reader.read(spec_schema(), &result.spec, *document, "");
  result.text = problems.text();
  result.given = reader.given();
  return result;
}

TEST(Schema, FillsDefaultsAndRemembersWhatWasGiven) {
  const Result result = read("length = 2");
  EXPECT_EQ(result.text, "");
  EXPECT_EQ(result.spec.length, 2);
  EXPECT_EQ(result.spec.ratio, 0.25);
  EXPECT_FALSE(result.spec.extra);
  EXPECT_EQ(result.spec.count, 2);
  EXPECT_TRUE(result.spec.on);
  EXPECT_EQ(result.spec.label, "none");
  EXPECT_EQ(result.spec.words, std::vector<std::string>{"x"});
  EXPECT_EQ(result.spec.color, Color::green);
  EXPECT_EQ(result.spec.inner.depth, 1);
  EXPECT_EQ(result.given, std::set<std::string>{"length"});
}

TEST(Schema, ReadsEveryKind) {
  const Result result = read(
      "length = \"30 cm\"\nratio = 0\nextra = \"5 ms\"\ncount = 4\non = false\nlabel = \"hi\"\n"
      "words = [\"u\", \"v\"]\ncolor = \"red\"\npoint = [1, \"20 cm\"]\n"
      "velocity = [\"2 m/s\", \"3*t\"]\ninner = { type = \"b\", width = 3 }\n"
      "parts = [\"a\", 4, { type = \"b\", width = 1 }]\n");
  EXPECT_EQ(result.text, "");
  EXPECT_EQ(result.spec.length, 0.3);
  EXPECT_EQ(result.spec.extra, 0.005);
  EXPECT_EQ(result.spec.count, 4);
  EXPECT_FALSE(result.spec.on);
  EXPECT_EQ(result.spec.words, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(result.spec.color, Color::red);
  EXPECT_EQ(result.spec.point[0], 1);
  EXPECT_EQ(result.spec.point[1], 0.2);
  EXPECT_EQ(result.spec.point[2], 0);
  EXPECT_EQ(result.spec.velocity[0].text, "2.0");
  EXPECT_EQ(result.spec.velocity[1].text, "3*t");
  EXPECT_FALSE(result.spec.velocity[2].given());
  EXPECT_EQ(result.spec.inner.width, 3);
  ASSERT_EQ(result.spec.parts.size(), 3u);
  EXPECT_EQ(result.spec.parts[1].depth, 4);  // a bare number is depth
  EXPECT_EQ(result.spec.parts[2].type, "b");
}

struct Case {
  const char* toml;
  const char* text;
};

class SchemaFaults : public testing::TestWithParam<Case> {};

TEST_P(SchemaFaults, HaveOneSentence) { EXPECT_EQ(read(GetParam().toml).text, GetParam().text); }

INSTANTIATE_TEST_SUITE_P(
    Sentences, SchemaFaults,
    testing::Values(
        Case{"",
             "f:1:1: length: required key is missing; allowed: a length [m]; add length = ...\n"},
        Case{"length = 1\ncount = 10",
             "f:2:9: count = 10: is too large; allowed: at least 1 and at most 9\n"},
        Case{"length = 1\ncount = 2.0",
             "f:2:9: count = 2.0: is a number, must be an integer; allowed: at least 1 and at most "
             "9\n"},
        Case{"length = 1\non = 1",
             "f:2:6: on = 1: is an integer, must be a boolean; allowed: true, false\n"},
        Case{"length = 1\nwords = \"u\"",
             "f:2:9: words = \"u\": is a text, must be an array of texts; write [ \"...\" ]\n"},
        Case{"length = 1\ncolor = \"gren\"",
             "f:2:9: color = \"gren\": unknown name; allowed: red, green; did you mean "
             "\"green\"?\n"},
        Case{"length = 1\ncolor = 3",
             "f:2:9: color = 3: is an integer, must be one of the names; allowed: red, green\n"},
        Case{"length = 1\ninner = \"c\"",
             "f:2:9: inner.type = \"c\": not available in this version; available: a, b\n"},
        Case{"length = 1\ninner = { type = \"b\", width = 1, depth = 2 }",
             "f:2:42: inner.depth = 2: does not belong to type = \"b\"; allowed: type, width; "
             "remove "
             "it, or set type to a\n"},
        Case{"length = 1\ninner = true",
             "f:2:9: inner = true: is a boolean, must be a table; allowed: type, depth, width; "
             "write "
             "{ type = ... }\n"},
        Case{"length = 1\npoint = [1, 2, 3]",
             "f:2:9: point = [1, 2, 3]: has 3 entries; allowed: 2 numbers (domain.dimension); "
             "remove "
             "the third entry, or set domain.dimension = 3\n"},
        Case{"length = 1\npoint = 4",
             "f:2:9: point = 4: is an integer, must be an array; allowed: 2 numbers "
             "(domain.dimension)\n"},
        Case{"length = 1\nparts = []", "f:2:9: parts = []: must be an array of tables\n"},
        Case{"length = 1\nratio = nan",
             "f:2:9: ratio = nan: is not finite; allowed: at least 0 and below 0.5; write a finite "
             "number\n"},
        Case{"length = 1e400",
             "f:1:10: length = 1e400: is not finite; allowed: above 0 m; write a finite number\n"},
        Case{"length = \"2 sec\"",
             "f:1:10: length = \"2 sec\": has the unknown unit \"sec\"; allowed: m, mm, cm, km\n"},
        Case{"length = \"long\"",
             "f:1:10: length = \"long\": is not a number with a unit; allowed: a number in m or a "
             "quoted number with a unit (m, mm, cm, km)\n"},
        Case{"length = 1979-05-27",
             "f:1:10: length = 1979-05-27: is a date or time, must be a number; allowed: a number "
             "in m "
             "or a quoted number with a unit (m, mm, cm, km)\n"},
        Case{"length = 0.2\nratio = 0.4",
             "f:2:9: ratio = 0.4: is not below length; allowed: less; shrink it\n"},
        Case{"lenght = 1",
             "f:1:1: length: required key is missing; allowed: a length [m]; is it meant by "
             "the unknown key \"lenght\"?\n"
             "f:1:1: lenght = 1: unknown key; allowed: length, ratio, extra, count, on, label, "
             "words, "
             "color, point, velocity, inner, parts; did you mean \"length\"?\n"}));

TEST(Schema, ChecksWithKeysRunBesideOtherProblems) {
  const std::string text = read("length = 0.2\nratio = 0.4\ncount = 0").text;
  EXPECT_NE(text.find("ratio = 0.4: is not below length"), std::string::npos) << text;
  EXPECT_NE(text.find("count = 0: is too small"), std::string::npos) << text;
}

TEST(Schema, UnknownDimensionAcceptsBothLengths) {
  EXPECT_EQ(read("length = 1\npoint = [1, 2]", 0).text, "");
  EXPECT_EQ(read("length = 1\npoint = [1, 2, 3]", 0).text, "");
  EXPECT_NE(read("length = 1\npoint = [1]", 0).text, "");
}

TEST(Toml, NumbersReadBackExactly) {
  for (const double x : {0.1, 1.0 / 3, 1e-300, 2e6, -0.0, 123456789.0}) {
    Problems problems;
    const auto document = parse_document("x = " + toml_number(x), "f", problems);
    ASSERT_TRUE(document) << toml_number(x);
    ASSERT_TRUE(document->items[0].is(Value::Kind::real)) << toml_number(x);
    EXPECT_EQ(document->items[0].real, x);
  }
}

TEST(Toml, TextsReadBackExactly) {
  const std::string text = "a \"quoted\" \\ back\nline\ttab \x01 \xc3\xa4";
  Problems problems;
  const auto document = parse_document("x = " + toml_string(text), "f", problems);
  ASSERT_TRUE(document) << problems.text();
  EXPECT_EQ(document->items[0].text, text);
}

}  // namespace
}  // namespace scree

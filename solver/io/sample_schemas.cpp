// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "solver/io/sample_spec.hpp"

namespace scree {
namespace {

using Result = std::optional<Finding>;

template <class S>
void add_common(Schema<S>& s) {
  s.number("every", &S::every, Unit::time)
      .above(0)
      .fallback_text("history.every")
      .doc(
          "Time between the times at which rows are added; the first is t = 0, the last time.end.");
  s.texts("fields", &S::fields)
      .fallback({"velocity", "stress"})
      .doc("Particle fields, as in output.fields.");
}

const char* const mean_doc =
    " Means are weighted with the particles' volumes; `particles` is how many there were.";

Schema<ProbeSpec> make_probe_schema() {
  Schema<ProbeSpec> s(
      "probe",
      "A table over time, probes/NAME.csv, of a place or of one particle." + std::string(mean_doc));
  s.choice("type", &ProbeSpec::type,
           {{"point", ProbeType::point}, {"particle", ProbeType::particle}})
      .fallback(ProbeType::point)
      .doc("point: the mean of the particles around a place; particle: one particle on its way.");
  s.vector("at", &ProbeSpec::at, Unit::length)
      .fallback_text("none; id takes its place")
      .doc("The place; of a particle its place at t = 0, the nearest one is followed.");
  s.number("radius", &ProbeSpec::radius, Unit::length)
      .above(0)
      .when("type", {"point"})
      .fallback_text("domain.cell_size")
      .doc("Particles nearer than this count, with a weight that falls linearly to 0 there.");
  s.number("id", &ProbeSpec::id)
      .at_least(0)
      .when("type", {"particle"})
      .fallback_text("the nearest to `at`")
      .doc("The particle's number, as in the frames.");
  add_common(s);
  s.check({"at", "id", "type"}, [](const ProbeSpec& p, const SchemaContext&) -> Result {
    const bool placed = !std::isnan(p.at[0]);
    if (p.id && *p.id != std::floor(*p.id)) {
      return Finding{"id", "is no whole number", "the number of a particle", ""};
    }
    if (p.id && placed) {
      return Finding{"id", "is given together with at, but either says which particle", "",
                     "remove one of them"};
    }
    if (p.id || placed) return std::nullopt;
    return Finding{"at", "required key is missing", "a length [m] for each axis",
                   p.type == ProbeType::point ? "add at = ..." : "add at = ... or id = ..."};
  });
  return s;
}

Schema<ProfileSpec> make_profile_schema() {
  Schema<ProfileSpec> s("profile",
                        "A table over time, profiles/NAME.csv, of means over bins along a line." +
                            std::string(mean_doc) + " Bins without particles have no row.");
  s.vector("from", &ProfileSpec::from, Unit::length).doc("Where the line begins.");
  s.vector("to", &ProfileSpec::to, Unit::length).doc("Where it ends.");
  s.integer("bins", &ProfileSpec::bins)
      .at_least(1)
      .at_most(1000000)
      .fallback(50)
      .doc("Number of bins, all of one length.");
  s.number("radius", &ProfileSpec::radius, Unit::length)
      .above(0)
      .fallback_text("domain.cell_size")
      .doc("Particles nearer to the line than this count.");
  add_common(s);
  s.check({"from", "to"}, [](const ProfileSpec& p, const SchemaContext&) -> Result {
    if (p.from != p.to) return std::nullopt;
    return Finding{"to", "is the same as from, so the line has no length", "", "move one of them"};
  });
  return s;
}

Schema<SectionSpec> make_section_schema() {
  Schema<SectionSpec> s("section",
                        "A table over time, sections/NAME.csv, of means over square bins in a "
                        "plane of the domain." +
                            std::string(mean_doc) + " Bins without particles have no row.");
  s.choice("normal", &SectionSpec::normal,
           {{"x", SectionNormal::x}, {"y", SectionNormal::y}, {"z", SectionNormal::z}})
      .in_dimension(3)
      .doc("The axis across the plane. In 2D the plane is that of the run.");
  s.number("position", &SectionSpec::position, Unit::length)
      .in_dimension(3)
      .doc("Where the plane lies on that axis.");
  s.number("spacing", &SectionSpec::spacing, Unit::length)
      .above(0)
      .fallback_text("domain.cell_size")
      .doc("Side of a bin; the first one lies at the domain's lower corner.");
  s.number("thickness", &SectionSpec::thickness, Unit::length)
      .above(0)
      .in_dimension(3)
      .fallback_text("spacing")
      .doc("Particles nearer to the plane than half of this count.");
  s.table("region", &SectionSpec::region, &shape_schema)
      .fallback_text("everywhere")
      .doc("Only particles in this shape count.");
  add_common(s);
  return s;
}

}  // namespace

const Schema<ProbeSpec>& probe_schema() {
  static const Schema<ProbeSpec> schema = make_probe_schema();
  return schema;
}

const Schema<ProfileSpec>& profile_schema() {
  static const Schema<ProfileSpec> schema = make_profile_schema();
  return schema;
}

const Schema<SectionSpec>& section_schema() {
  static const Schema<SectionSpec> schema = make_section_schema();
  return schema;
}

}  // namespace scree

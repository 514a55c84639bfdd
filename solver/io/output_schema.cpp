// SPDX-License-Identifier: Apache-2.0
#include "solver/io/output_spec.hpp"

namespace scree {
namespace {

using Output = Schema<OutputSpec>;

void add_format(Output& s, bool further) {
  std::vector<std::pair<std::string, FrameFormat>> formats{{"vtu", FrameFormat::vtu},
                                                           {"xdmf", FrameFormat::xdmf}};
  std::string doc =
      "vtu: one VTK file a frame and a .pvd series of them; xdmf: all frames in one HDF5 file and "
      "an .xdmf index of it, for long and large runs";
  if (!further) {
    formats.emplace_back("none", FrameFormat::none);
    doc += "; none: no frames";
  }
  s.choice("format", &OutputSpec::format, formats).fallback(FrameFormat::vtu).doc(doc + ".");
  s.choice("precision", &OutputSpec::precision,
           {{"single", FramePrecision::single_}, {"double", FramePrecision::double_}})
      .fallback(FramePrecision::single_)
      .doc("Floating-point type of the fields in the frames; positions are always double.");
  s.choice("compression", &OutputSpec::compression,
           {{"none", FrameCompression::none}, {"deflate", FrameCompression::deflate}})
      .when("format", {"xdmf"})
      .fallback(FrameCompression::none)
      .doc("deflate: arrays are packed (level 1), which makes files smaller and writing slower.");
}

void add_content(Output& s) {
  s.texts("fields", &OutputSpec::fields)
      .fallback({"velocity", "stress"})
      .doc(
          "Particle fields besides id, material and body: those of the list of fields, the history "
          "fields of the materials in use, and with pore water pore_pressure and "
          "effective_stress. stress and pressure are total where there is pore water, all that "
          "follows from a stress is of the effective one.");
  s.flag("grid", &OutputSpec::grid).fallback(false).doc("Also writes the nodes of the grid.");
  s.integer("every_nth", &OutputSpec::every_nth)
      .at_least(1)
      .fallback(1)
      .doc("Only particles whose id is a multiple of this number are written.");
  s.table("region", &OutputSpec::region, &shape_schema)
      .fallback_text("everywhere")
      .doc("Only particles that are in this shape, rim included, at the time of the frame.");
  s.number("from", &OutputSpec::from, Unit::time)
      .at_least(0)
      .fallback(0)
      .doc("No frames before this time; frames stay at multiples of every.");
  s.number("until", &OutputSpec::until, Unit::time)
      .at_least(0)
      .fallback_text("time.end")
      .doc("No frames after this time.");
  s.check({"from", "until"}, [](const OutputSpec& o, const SchemaContext&) {
    std::optional<Finding> finding;
    if (o.until && *o.until < o.from) {
      finding = Finding{"until", "is before from, so there would be no frame", "from or later", ""};
    }
    return finding;
  });
}

Output make_output_schema() {
  Output s("output", "Frames of the particles and the grid, for ParaView.");
  s.number("every", &OutputSpec::every, Unit::time)
      .above(0)
      .fallback_text("time.end")
      .doc("Time between frames; the first frame is t = 0, the last time.end.");
  add_format(s, false);
  add_content(s);
  return s;
}

Output make_frames_schema() {
  Output s("frames",
           "A further series of frames besides that of [output], e.g. of a few fields more often; "
           "its files are called by its name.");
  s.number("every", &OutputSpec::every, Unit::time)
      .above(0)
      .fallback_text("output.every")
      .doc("Time between frames; the first frame is t = 0, the last time.end.");
  add_format(s, true);
  add_content(s);
  return s;
}

Schema<HistorySpec> make_history_schema() {
  Schema<HistorySpec> s("history", "Rows of history.csv: sums over all particles.");
  s.number("every", &HistorySpec::every, Unit::time)
      .above(0)
      .fallback_text("output.every")
      .doc("Time between rows.");
  return s;
}

Schema<CheckpointSpec> make_checkpoint_schema() {
  Schema<CheckpointSpec> s("checkpoint", "States from which a run can be resumed.");
  s.number("every", &CheckpointSpec::every, Unit::time)
      .above(0)
      .fallback_text("none; a signal, --until and --max-steps still write one")
      .doc("Time between checkpoints.");
  return s;
}

}  // namespace

const Schema<OutputSpec>& output_schema() {
  static const Schema<OutputSpec> schema = make_output_schema();
  return schema;
}

const Schema<OutputSpec>& frames_schema() {
  static const Schema<OutputSpec> schema = make_frames_schema();
  return schema;
}

const Schema<HistorySpec>& history_schema() {
  static const Schema<HistorySpec> schema = make_history_schema();
  return schema;
}

const Schema<CheckpointSpec>& checkpoint_schema() {
  static const Schema<CheckpointSpec> schema = make_checkpoint_schema();
  return schema;
}

}  // namespace scree

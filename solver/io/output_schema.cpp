// SPDX-License-Identifier: Apache-2.0
#include "solver/io/output_spec.hpp"

namespace scree {
namespace {

Schema<OutputSpec> make_output_schema() {
  Schema<OutputSpec> s("output", "Frames of the particles and the grid, for ParaView.");
  s.number("every", &OutputSpec::every, Unit::time)
      .above(0)
      .fallback_text("time.end")
      .doc("Time between frames; the first frame is t = 0, the last time.end.");
  s.choice("format", &OutputSpec::format,
           {{"vtu", FrameFormat::vtu}, {"xdmf", FrameFormat::xdmf}, {"none", FrameFormat::none}})
      .fallback(FrameFormat::vtu)
      .doc(
          "vtu: one VTK file a frame and a .pvd series of them; xdmf: all frames in one HDF5 file "
          "and an .xdmf index of it, for long and large runs; none: no frames.");
  s.choice("precision", &OutputSpec::precision,
           {{"single", FramePrecision::single_}, {"double", FramePrecision::double_}})
      .fallback(FramePrecision::single_)
      .doc("Floating-point type of the fields in the frames; positions are always double.");
  s.choice("compression", &OutputSpec::compression,
           {{"none", FrameCompression::none}, {"deflate", FrameCompression::deflate}})
      .when("format", {"xdmf"})
      .fallback(FrameCompression::none)
      .doc(
          "deflate: the arrays are packed (level 1), which makes the file smaller and writing "
          "slower.");
  s.texts("fields", &OutputSpec::fields)
      .fallback({"velocity", "stress"})
      .doc(
          "Particle fields besides id, material and body: velocity, stress, pressure, mass, "
          "volume, displacement, the history fields of the materials in use, and with pore water "
          "pore_pressure and effective_stress. pressure is the mean of stress; both are total "
          "where there is pore water.");
  s.flag("grid", &OutputSpec::grid).fallback(false).doc("Also writes the nodes of the grid.");
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

const Schema<HistorySpec>& history_schema() {
  static const Schema<HistorySpec> schema = make_history_schema();
  return schema;
}

const Schema<CheckpointSpec>& checkpoint_schema() {
  static const Schema<CheckpointSpec> schema = make_checkpoint_schema();
  return schema;
}

}  // namespace scree

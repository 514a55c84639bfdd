// SPDX-License-Identifier: Apache-2.0
// scree post on frames with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "verification/support/process.hpp"
#include "verification/support/synthetic_run.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

ProcessResult post(std::vector<std::string> words) {
  words.insert(words.begin(), {SCREE_EXECUTABLE, "post"});
  return run_process(words);
}

/// The JSON that a command prints.
Json json_of(std::vector<std::string> words) {
  words.push_back("--json");
  const ProcessResult result = post(words);
  EXPECT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out, nullptr, false);
  EXPECT_TRUE(json.is_object()) << result.out;
  return json;
}

/// Column `name` of the rows.
std::vector<double> column(const Json& json, const std::string& name) {
  std::vector<double> values;
  for (std::size_t c = 0; c < json["columns"].size(); ++c) {
    if (json["columns"][c] != name) continue;
    for (const Json& row : json["rows"]) {
      values.push_back(row[c].is_number() ? row[c].get<double>() : std::nan(""));
    }
  }
  EXPECT_FALSE(values.empty()) << "no column " << name;
  return values;
}

constexpr double width = 0.1, height = 0.2, spacing = 0.01;

/// A column 0.1 x 0.2 m in 2D, at rest; then three times as wide and half as high.
void add_column(SyntheticRun& run) {
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {width, height, 0}}, spacing, 2);
  add_field(body, "pressure", [](const double* x) { return 1000 * 10 * (height - x[1]); });
  run.add(body, 0);
  for (std::size_t p = 0; p < body.id.size(); ++p) {
    body.position[3 * p] *= 3;
    body.position[3 * p + 1] /= 2;
  }
  run.add(body, 1);
}

TEST(PostProfile, ALinearFieldIsMetAtTheBins) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const Json json = json_of({"profile", run.path(), "--field", "pressure", "--time", "0"});
  const auto y = column(json, "y"), p = column(json, "pressure"), n = column(json, "particles");
  ASSERT_EQ(y.size(), 10u);  // height / cell size
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(p[i], 1e4 * (height - y[i]), 1e-9);  // means of a linear field: rounding
    EXPECT_EQ(n[i], 2 * width / spacing);
  }
}

TEST(PostProfile, ALineCountsTheParticlesNearIt) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const Json json =
      json_of({"profile", run.path(), "--field", "pressure", "--time", "0", "--from", "0", "0.105",
               "--to", "0.1", "0.105", "--width", "0.008", "--bins", "5"});
  for (const double count : column(json, "particles")) EXPECT_EQ(count, 2);
  for (const double p : column(json, "pressure")) EXPECT_NEAR(p, 1e4 * 0.095, 1e-9);
}

TEST(PostRunout, FrontAndHeightAreThoseOfTheBody) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const Json json = json_of({"runout", run.path(), "--share", "1", "--law", "lube,lajeunesse"});
  // Particles end half their spacing of t = 0, cell size / 2 / 2, beyond their centres.
  const double half = 0.5 * 0.02 / 2;
  const auto front = column(json, "front"), top = column(json, "height");
  EXPECT_NEAR(front[0], width, 1e-12);
  EXPECT_NEAR(top[0], height, 1e-12);
  EXPECT_NEAR(front[1], 3 * (width - half) + half, 1e-12);
  EXPECT_EQ(json["facts"]["direction"], "+x");
  const double a = height / width;
  EXPECT_NEAR(json["facts"]["aspect_ratio"].get<double>(), a, 1e-12);
  EXPECT_NEAR(json["facts"]["lube_front"].get<double>(), width * (1 + 1.2 * a), 1e-12);
  EXPECT_NEAR(json["facts"]["lajeunesse_height"].get<double>(), width * std::cbrt(a), 1e-12);
  EXPECT_NEAR(json["facts"]["collapse_time"].get<double>(), 3.3 * std::sqrt(height / 10), 1e-12);
}

TEST(PostRunout, ARadialSpreadIsMeasuredFromTheAxisThatStays) {
  SyntheticRun run(3, {1, 1, 1}, 0.1);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {0.4, 0.4, 0.2}}, 0.05, 3);
  run.add(body, 0);
  for (std::size_t p = 0; p < body.id.size(); ++p) {
    body.position[3 * p] *= 2;
    body.position[3 * p + 1] *= 2;
  }
  run.add(body, 1);
  const Json json = json_of({"runout", run.path(), "--direction", "radial"});
  const double corner = 2 * std::sqrt(2.0) * (0.4 - 0.025) + 0.025;
  // The axis lies at the corner of the body that stays, up to the half spacing that moves with it.
  EXPECT_NEAR(column(json, "farthest")[1], corner, 1e-12);
}

/// A history of one kilogram that falls from rest and stops at t = 0.5 s.
void write_history(const SyntheticRun& run) {
  std::string text =
      "step,time,dt,particle_count,mass,center_x,center_y,center_z,kinetic_energy,"
      "elastic_energy\n";
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.1 * i, fall = std::min(t, 0.5);
    const double kinetic = i <= 5 ? 0.5 * std::pow(10 * t, 2) : 0;
    text += fmt::format("{},{},0.1,1,1,0,{},0,{},{}\n", i, t, 2 - 5 * fall * fall, kinetic,
                        i > 5 ? 2.0 : 0.0);
  }
  write_text(run / "history.csv", text + "11,1.1");  // the row that is being written
}

TEST(PostEnergy, WhatIsNeitherKineticNorElasticIsDissipated) {
  SyntheticRun run(2, {1, 1, 0}, 0.1);
  write_history(run);
  const Json json = json_of({"energy", run.path()});
  const auto lost = column(json, "dissipated"), work = column(json, "gravity_work");
  ASSERT_EQ(lost.size(), 11u);
  for (std::size_t i = 0; i <= 5; ++i) EXPECT_NEAR(lost[i], 0, 1e-12);  // free fall
  EXPECT_NEAR(work[10], 10 * 5 * 0.25, 1e-12);                          // m g h
  EXPECT_NEAR(lost[10], 10 * 5 * 0.25 - 2, 1e-12);
}

TEST(PostSection, CellsOfAPlaneHoldTheMeanOfTheirParticles) {
  SyntheticRun run(3, {1, 1, 1}, 0.1);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {1, 1, 0.5}}, 0.05, 3);
  add_field(body, "f", [](const double* x) { return 3 * x[0] + x[2]; });
  run.add(body, 0);
  const Json json =
      json_of({"section", run.path(), "--field", "f", "--normal", "y", "--position", "0.5"});
  const auto x = column(json, "x"), z = column(json, "z"), f = column(json, "f");
  ASSERT_EQ(x.size(), 10u * 5u);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(f[i], 3 * x[i] + z[i], 1e-12);
}

TEST(PostSurface, TheLevelLiesAtTheTopOfTheBody) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  run.add(lattice_particles({{0, 0, 0}, {0.2, 0.19, 0}}, spacing, 2), 0);
  const std::string mesh = run / "surface.vtp";
  const Json json = json_of({"surface", run.path(), "--mesh", mesh});
  const auto x = column(json, "x"), top = column(json, "height");
  int inner = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] > 0.19) continue;         // at the side the body is half filled
    EXPECT_NEAR(top[i], 0.19, 1e-12);  // equal layers: linear between nodes
    ++inner;
  }
  EXPECT_EQ(inner, 10);  // nodes from the wall, a mirror, on
  EXPECT_TRUE(std::filesystem::exists(mesh));
}

TEST(PostSlip, ADiagonalBandHasItsLengthAndAngle) {
  const double h = 0.02;
  SyntheticRun run(2, {0.8, 0.3, 0}, h);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {0.2, 0.2, 0}}, spacing, 2);
  add_field(body, "strain", [&](const double* x) {
    return std::floor(x[0] / h) == std::floor(x[1] / h) ? 1.0 : 0.0;
  });
  run.add(body, 0);
  const Json json = json_of(
      {"slip", run.path(), "--field", "strain", "--threshold", "0.5", "--plot", run / "slip.svg"});
  ASSERT_EQ(json["rows"].size(), 1u);
  EXPECT_EQ(column(json, "cells")[0], 10);
  EXPECT_NEAR(column(json, "angle")[0], 45, 1e-9);
  const double length = h * (9 * std::sqrt(2.0) + 1);
  EXPECT_NEAR(column(json, "length")[0], length, 1e-12);
  EXPECT_NEAR(column(json, "thickness")[0], 10 * h * h / length, 1e-12);
  EXPECT_NE(read_text(run / "slip.svg").find("</svg>"), std::string::npos);
}

/// A slab of bands in 3D: the picture looks along the shorter horizontal axis, y; and the plastic
/// strain that the frames hold is found by itself.
TEST(PostSlip, ABandInSpaceIsDrawnFromTheSide) {
  const double h = 0.1;
  SyntheticRun run(3, {1, 0.4, 1}, h);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {1, 0.4, 1}}, h / 2, 3);
  add_field(body, "equivalent_plastic_shear_strain",
            [&](const double* x) { return std::floor(x[0] / h) == 4 ? 1.0 : 0.0; });
  run.add(body, 0);
  const Json json = json_of({"slip", run.path(), "--threshold", "0.5", "--plot", run / "slip.svg"});
  ASSERT_EQ(json["rows"].size(), 1u);
  EXPECT_EQ(column(json, "cells")[0], 40);
  EXPECT_NEAR(column(json, "angle")[0], 90, 1e-9);  // a plane x = const
  const std::string picture = read_text(run / "slip.svg");
  EXPECT_NE(picture.find("x (m)"), std::string::npos);
  EXPECT_NE(picture.find("z (m)"), std::string::npos);
  EXPECT_NE(picture.find("largest along y"), std::string::npos);
}

TEST(PostSlip, FramesWithoutAStrainAreNamed) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const ProcessResult result = post({"slip", run.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("no plastic strain"), std::string::npos) << result.err;
}

TEST(PostDefaults, SpeedAndPressureAreTakenWithoutAField) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {width, height, 0}}, spacing, 2);
  SnapshotField velocity{"velocity", "m/s", 3, {}};
  for (std::size_t p = 0; p < body.id.size(); ++p) {
    velocity.values.insert(velocity.values.end(), {3, -4, 0});
  }
  body.fields.push_back(velocity);
  add_field(body, "pressure", [](const double* x) { return 1000 * 10 * (height - x[1]); });
  run.add(body, 0);
  for (const char* command : {"profile", "section"}) {
    const Json json = json_of({command, run.path()});
    EXPECT_NEAR(column(json, "velocity.magnitude")[0], 5, 1e-12);
    EXPECT_GT(column(json, "pressure")[0], 0);
    EXPECT_EQ(json["units"]["pressure"], "Pa");
  }
}

TEST(PostPlots, ChartsAreDrawnInBothFormats) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  for (const char* name : {"profile.png", "profile.svg"}) {
    ASSERT_EQ(post({"profile", run.path(), "--field", "pressure", "--all", "--plot", run / name,
                    "--quiet"})
                  .status,
              0);
  }
  EXPECT_EQ(read_text(run / "profile.png").substr(1, 3), "PNG");
  EXPECT_NE(read_text(run / "profile.svg").find("Pressure (Pa)"), std::string::npos);
}

TEST(PostCompare, AnExactSolutionHasNoDifference) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const Json json = json_of({"compare", run.path(), "--exact", "position.x=X*(1+2*t)", "--exact",
                             "pressure=1e4*(0.2-Y)+100*t", "--all"});
  const auto l2 = column(json, "l2"), largest = column(json, "linf");
  ASSERT_EQ(l2.size(), 4u);
  EXPECT_NEAR(l2[0], 0, 1e-12);
  EXPECT_NEAR(l2[2], 0, 1e-12);
  EXPECT_NEAR(l2[3], 100, 1e-9);  // the added error
  EXPECT_NEAR(largest[3], 100, 1e-9);
}

TEST(PostCompare, TwoRunsAreMatchedByParticleAndATolerancePasses) {
  SyntheticRun one(2, {0.8, 0.3, 0}, 0.02), two(2, {0.8, 0.3, 0}, 0.02);
  add_column(one);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {width, height, 0}}, spacing, 2);
  add_field(body, "pressure", [](const double* x) { return 1000 * 10 * (height - x[1]); });
  two.add(body, 0);
  add_field(body, "other", [](const double*) { return 0.0; });
  for (double& p : body.fields[0].values) p *= 1.25;
  two.add(body, 1);
  const Json json = json_of({"compare", one.path(), two.path(), "--fields", "pressure"});
  EXPECT_EQ(json["facts"]["matched"], "particle by particle");
  EXPECT_NEAR(column(json, "relative_l2")[0], 0.2, 1e-12);  // (1.25 - 1)/1.25
  const ProcessResult strict = post(
      {"compare", one.path(), two.path(), "--fields", "pressure", "--tolerance", "0.1", "--quiet"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(strict.err.find("above the tolerance 0.1"), std::string::npos) << strict.err;
}

TEST(PostConvert, ATableHasAllComponents) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const std::string file = run / "table.csv";
  ASSERT_EQ(post({"convert", run.path(), "-o", file, "--time", "0"}).status, 0);
  const std::string text = read_text(file);
  EXPECT_EQ(text.substr(0, text.find('\n')), "id,material,body,x,y,z,pressure");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 201);
}

TEST(PostProject, TheCommandWritesAGridAndSaysHowItWent) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  for (const char* name : {"grid.vti", "grid.vtu", "grid.xdmf"}) {
    const Json json = json_of({"project", run.path(), "-o", run / name, "--fields", "pressure"});
    EXPECT_EQ(json["rows"].size(), 1u);
    EXPECT_LT(column(json, "conservation_error")[0], 1e-6);
    EXPECT_GT(column(json, "iterations")[0], 0);
    EXPECT_TRUE(std::filesystem::exists(run / name));
  }
  EXPECT_TRUE(std::filesystem::exists(run / "grid.h5"));
}

TEST(PostProject, OptionsReachPetscAndUnknownOnesAreRefused) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const std::string file = run / "grid.vti";
  const ProcessResult amg =
      post({"project", run.path(), "-o", file, "--", "-scree_project_pc_type", "gamg"});
  EXPECT_EQ(amg.status, 0) << amg.err;
  EXPECT_NE(amg.out.find("cg + gamg"), std::string::npos) << amg.out;
  std::filesystem::remove(file);
  const ProcessResult wrong =
      post({"project", run.path(), "-o", file, "--petsc-options", "-scree_project_pc_tpye gamg"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("-scree_project_pc_tpye"), std::string::npos) << wrong.err;
  const ProcessResult short_run =
      post({"project", run.path(), "-o", file, "--petsc-options", "-scree_project_ksp_max_it 1"});
  EXPECT_EQ(short_run.status, 1);
  EXPECT_NE(short_run.err.find("did not converge"), std::string::npos) << short_run.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(PostProject, TwoProcessesFindTheSameField) {
  if (std::system("command -v mpirun > /dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  ASSERT_EQ(post({"project", run.path(), "-o", run / "one.vti"}).status, 0);
  const ProcessResult two = run_process(
      {"/usr/bin/env", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun",
       "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "--oversubscribe", "-np", "2",
       SCREE_EXECUTABLE, "post", "project", run.path(), "-o", run / "two.vti", "--json"});
  ASSERT_EQ(two.status, 0) << two.err;
  const Json json = Json::parse(two.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << two.out;
  EXPECT_EQ(json["facts"]["processes"], 2);
  EXPECT_LT(column(json, "conservation_error")[0], 1e-6);
}

TEST(PostErrors, MistakesAreNamed) {
  SyntheticRun run(2, {0.8, 0.3, 0}, 0.02);
  add_column(run);
  const auto refused = [](const std::vector<std::string>& words, const std::string& sentence) {
    const ProcessResult result = post(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  refused({"profil", run.path()}, "did you mean \"profile\"?");
  refused({"profile", run / "none", "--field", "pressure"}, "there is no run folder");
  refused({"profile", run.path(), "--field", "presure"}, "did you mean pressure?");
  refused({"profile", run.path(), "--field", "pressure.xx"}, "is a single number");
  refused({"profile", run.path(), "--field", "pressure", "--time", "9"}, "from 0 to 1 s");
  refused({"profile", run.path(), "--field", "pressure", "-o", run / "history.csv"},
          "is a file of the run itself");
  refused({"profile", run.path(), "--field", "pressure", "--", "-x"}, "takes nothing after --");
  refused({"runout", run.path(), "--direction", "y"}, "must be horizontal");
  refused({"project", run.path(), "-o", run / "a.png"}, "must end in .vti");
  refused({"compare", run.path(), "--exact", "pressure=sin("}, "sin(");
  refused({"profile", run.path(), "--field", "pressure", "--tim", "0"}, "did you mean --time?");
}

}  // namespace
}  // namespace scree

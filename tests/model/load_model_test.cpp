// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "model_fields.hpp"
#include "temporary_folder.hpp"
#include "urdf_test.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A door with a knob fixed to it, and a bolt, on a frame; and the YAML file beside it.
class LoadModelTest : public testing::Test {
 protected:
  ArticulatedModel load(const std::string& yaml, std::string* warnings = nullptr) const {
    folder_.write("door.yaml", yaml);
    const auto urdf = folder_.write(
        "door.urdf", "<robot name=\"r\">" + link("frame") + link("door", box("0.1 0.1 0.02")) +
                         link("knob", box("0.02 0.02 0.04")) + link("bolt", box("0.04 0.02 0.02")) +
                         joint("hinge", "revolute", "frame", "door", kLimit) +
                         joint("glue", "fixed", "door", "knob", "<origin xyz=\"0 0 0.02\"/>") +
                         joint("slide", "prismatic", "frame", "bolt",
                               "<origin xyz=\"0.2 0 0\"/>" + std::string(kLimit)) +
                         joint("shadow", "prismatic", "bolt", "tip",
                               "<mimic joint=\"slide\"/>" + std::string(kLimit)) +
                         link("tip") + "</robot>");
    LoadOptions options;
    options.cache_directory = folder_ / "cache";
    if (warnings != nullptr) {
      options.on_warning = [warnings](const std::string& text) { *warnings += text; };
    }
    return load_model(urdf, options);
  }

  std::string refusal(const std::string& yaml) const {
    return message_of<InputError>([&] { load(yaml); });
  }

  const TemporaryFolder folder_;
};

TEST_F(LoadModelTest, BuildsOneFieldForEachBodyWithGeometry) {
  const ArticulatedModel model = load("voxel: 0.004\nlink_voxel: {bolt: 0.002}\n");
  ASSERT_EQ(model.fields.size(), model.tree.bodies.size());
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    const Body& body = model.tree.bodies[b];
    ASSERT_EQ(model.fields[b].has_value(), !body.visuals.empty()) << body.name;
    if (!model.fields[b]) continue;
    EXPECT_NEAR(model.fields[b]->voxel(), body.name == "bolt" ? 0.002 : 0.004, 1e-9);
    const DistanceSample centre = model.fields[b]->sample(Eigen::Vector3f::Zero());
    EXPECT_NEAR(centre.distance, -0.01F, 2e-3F);
  }
}

constexpr double kRing = 0.08;  // radii of a torus, metres
constexpr double kTube = 0.03;
constexpr int kFacets = 100;  // along each of its circles

/// With a knob upon it, 5 mm wide.
std::string torus_obj(double knob) {
  std::ostringstream obj;
  const auto vertex = [](int i, int j) {
    return std::to_string(1 + (i % kFacets) * kFacets + j % kFacets) + ' ';
  };
  for (int i = 0; i < kFacets; ++i) {
    for (int j = 0; j < kFacets; ++j) {
      const double a = 2.0 * std::numbers::pi * i / kFacets;
      const double b = 2.0 * std::numbers::pi * j / kFacets;
      const Eigen::Vector2d aside(kRing * std::sin(0.5 * a), kTube * (b - 0.5 * std::numbers::pi));
      const double tube = kTube + (aside.norm() < 0.005 ? knob : 0.0);
      const double r = kRing + tube * std::cos(b);
      obj << "v " << r * std::cos(a) << ' ' << r * std::sin(a) << ' ' << tube * std::sin(b) << '\n';
    }
  }
  for (int i = 0; i < kFacets; ++i) {
    for (int j = 0; j < kFacets; ++j) {
      obj << "f " << vertex(i, j) << vertex(i + 1, j) << vertex(i + 1, j + 1) << '\n';
      obj << "f " << vertex(i, j) << vertex(i + 1, j + 1) << vertex(i, j + 1) << '\n';
    }
  }
  return obj.str();
}

/// But its field, and what is shown of it, are those of all its triangles.
TEST_F(LoadModelTest, DrawsABodyOfManyTrianglesByFewer) {
  const auto file = folder_.write("torus.obj", torus_obj(0.0));
  LoadOptions options;
  options.cache_directory = folder_ / "cache";
  const ArticulatedModel model = load_model(file, options);
  const Body& body = model.tree.bodies.front();
  EXPECT_EQ(body.visuals.front().mesh.triangles.size(), 2U * kFacets * kFacets);
  EXPECT_LT(body.mesh.triangles.size(), 10000U);
  EXPECT_GT(body.mesh.triangles.size(), 1000U);
  for (const Eigen::Vector3d& p : body.mesh.vertices) {
    const double off = std::hypot(p.head<2>().norm() - kRing, p.z()) - kTube;
    EXPECT_NEAR(off, 0.0, model.fields.front()->voxel());
  }
  const double volume = model.fields.front()->storage().mesh_volume;
  EXPECT_NEAR(volume, signed_volume(body.visuals.front().mesh), 1e-9);
  EXPECT_NEAR(signed_volume(body.mesh), volume, 0.01 * volume);
}

TEST_F(LoadModelTest, DrawsSmallPartsOfABodyOfManyTriangles) {
  constexpr double kKnob = 0.006;  // metres high
  LoadOptions options;
  options.cache_directory = folder_ / "cache";
  const ArticulatedModel model = load_model(folder_.write("knob.obj", torus_obj(kKnob)), options);
  const TriangleMesh& drawn = model.tree.bodies.front().mesh;
  EXPECT_LT(drawn.triangles.size(), 10000U);
  EXPECT_NEAR(bounds(drawn).max().z(), kTube + kKnob, model.fields.front()->voxel());
}

TEST_F(LoadModelTest, KeepsFieldsInTheCacheGivenOrInThatOfTheUser) {
  load("voxel: 0.004\n");
  EXPECT_FALSE(std::filesystem::is_empty(folder_ / "cache"));
  ASSERT_EQ(setenv("XDG_CACHE_HOME", (folder_ / "xdg").c_str(), 1), 0);
  load_model(folder_ / "door.urdf");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_FALSE(std::filesystem::is_empty(folder_ / "xdg" / "lockbox"));
}

class FieldsTogether : public LoadModelTest {
 protected:
  /// The fields of door and bolt within so many bytes, for these voxels, or chosen ones.
  std::vector<std::optional<SignedDistanceField>> fields(const std::string& yaml,
                                                         double bytes) const {
    const ArticulatedModel model = load(yaml);
    return model_fields(model.file, model.tree.bodies, model.parameters, {}, bytes, Executor(1));
  }

  static double bytes_of(const std::vector<std::optional<SignedDistanceField>>& fields) {
    double bytes = 0.0;
    for (const auto& field : fields) {
      if (field) bytes += static_cast<double>(field->memory_bytes());
    }
    return bytes;
  }
};

TEST_F(FieldsTogether, AreRefusedBeyondTheMemoryOfTheModelWithGivenVoxels) {
  const std::string yaml = "voxel: 0.002\n";
  const double all = bytes_of(fields(yaml, 1e9));
  EXPECT_EQ(bytes_of(fields(yaml, 1.5 * all)), all);
  const std::string message = message_of<InputError>([&] { fields(yaml, 0.7 * all); });
  EXPECT_THAT(message, AllOf(HasSubstr("door.urdf: link '"), HasSubstr("of a model may take"),
                             HasSubstr("together")));
}

TEST_F(FieldsTogether, AreCoarsenedToKeepTheMemoryOfTheModelWhereVoxelsAreChosen) {
  const auto usual = fields("", 1e9);
  const double all = bytes_of(usual);
  const auto scarce = fields("", 0.85 * all);
  EXPECT_LE(bytes_of(scarce), 0.85 * all);
  int coarser = 0;
  for (std::size_t b = 0; b < usual.size(); ++b) {
    ASSERT_EQ(scarce[b].has_value(), usual[b].has_value());
    if (usual[b] && scarce[b]->voxel() > usual[b]->voxel()) ++coarser;
  }
  EXPECT_EQ(coarser, 1);
}

TEST_F(LoadModelTest, ReadsErosionsByAnyLinkOfABody) {
  const ModelParameters parameters =
      load("erosion: 0.001\npair_erosion:\n- {links: [knob, bolt], erosion: 0.002}\n").parameters;
  EXPECT_EQ(parameters.erosion, 0.001);
  ASSERT_EQ(parameters.pair_erosion.size(), 1U);
  EXPECT_EQ(parameters.pair_erosion.at({"bolt", "door"}), 0.002);
  EXPECT_FALSE(parameters.initial_configuration);
}

TEST_F(LoadModelTest, ReadsTheInitialState) {
  const ArticulatedModel model = load(
      "initial_state:\n"
      "  position: [0.1, 0.2, 1.3]\n"
      "  quaternion: [0, 0, 0.707, 0.707]\n"
      "  joints: {hinge: 0.5}\n");
  ASSERT_TRUE(model.parameters.initial_configuration);
  const Configuration& initial = *model.parameters.initial_configuration;
  EXPECT_TRUE(initial.T_camera_base.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 1.3)));
  EXPECT_TRUE(initial.T_camera_base.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_EQ(joint_position(model.tree, initial, joint_index(model.tree, "hinge")), 0.5);
  EXPECT_EQ(joint_position(model.tree, initial, joint_index(model.tree, "slide")), 0.0);
}

TEST_F(LoadModelTest, RefusesVoxelsAboveHalfTheThinnestWallByLink) {
  EXPECT_THAT(refusal("link_voxel: {bolt: 0.015}\n"),
              AllOf(HasSubstr("door.urdf"), HasSubstr("link 'bolt'"),
                    HasSubstr("the voxel is given in"), HasSubstr("door.yaml")));
}

TEST_F(LoadModelTest, RefusesOpenMeshesByLink) {
  folder_.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const auto urdf =
      folder_.write("open.urdf", "<robot name=\"r\">" +
                                     link("shell",
                                          "<visual><geometry><mesh filename=\"open.obj\"/>"
                                          "</geometry></visual>") +
                                     "</robot>");
  EXPECT_THAT(message_of<InputError>([&] { load_model(urdf); }), HasSubstr("link 'shell'"));
}

TEST_F(LoadModelTest, RefusesRobotsOfWhichNothingCanBeSeen) {
  const auto urdf = folder_.write(
      "frames.urdf", "<robot name=\"r\">" + link("frame") + link("tip") +
                         joint("slide", "prismatic", "frame", "tip", kLimit) + "</robot>");
  EXPECT_THAT(message_of<InputError>([&] { load_model(urdf); }),
              AllOf(HasSubstr("frames.urdf"), HasSubstr("<visual>")));
}

/// Many programs leave a YAML file with the stem of the model beside it.
TEST_F(LoadModelTest, PassesOverYamlOfOtherPrograms) {
  for (const std::string yaml :
       {"model: door\nversion: 2\n", "- voxel\n", "collision:\n  voxel: [1, 2]\n", "a: [\n",
        "%YAML:1.0\nK: !!opencv-matrix\n", "just text\n", "? {a: 1}\n: 2\n"}) {
    std::string warnings;
    EXPECT_FALSE(load(yaml, &warnings).parameters.voxel) << yaml;
    EXPECT_THAT(warnings, AllOf(HasSubstr("door.yaml: not read"), HasSubstr("link_voxel"))) << yaml;
  }
  for (const std::string yaml : {"", "# voxel: 4\n", "---\n"}) {
    std::string warnings;
    load(yaml, &warnings);
    EXPECT_EQ(warnings, "") << yaml;
  }
}

TEST_F(LoadModelTest, RefusesUnknownKeysAndBadValuesWithTheLine) {
  EXPECT_THAT(refusal("voxel: 0.004\nvoxels: 1\n"), HasSubstr("door.yaml:2: unknown key 'voxels'"));
  EXPECT_THAT(refusal("voxel: 0.004\nvoxel: 0.002\n"), HasSubstr("door.yaml:2: the key 'voxel'"));
  EXPECT_THAT(refusal("voxel: 4mm\n"), HasSubstr("door.yaml:1: '4mm' is not a finite number"));
  EXPECT_THAT(refusal("voxel: .nan\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("voxel: 0\n"), HasSubstr("must be positive"));
  EXPECT_THAT(refusal("erosion: -0.01\n"), HasSubstr("must not be negative"));
  EXPECT_THAT(refusal("link_voxel: {latch: 0.001}\n"), HasSubstr("no link 'latch'"));
  EXPECT_THAT(refusal("link_voxel: {frame: 0.001}\n"), HasSubstr("'frame' has no geometry"));
  EXPECT_THAT(refusal("link_voxel: {door: 0.002, knob: 0.001}\n"), HasSubstr("already"));
  EXPECT_THAT(refusal("voxel: [\n"), HasSubstr("not YAML"));
  for (const std::string key : {"voxels", "Voxel", "link_voxl", "errosion", "inital_state"}) {
    EXPECT_THAT(refusal(key + ": 1\n"), HasSubstr("unknown key '" + key + "'"));
  }
}

TEST_F(LoadModelTest, RefusesLengthsInMillimetresWithWhatToWrite) {
  EXPECT_THAT(refusal("voxel: 4\n"),
              AllOf(HasSubstr("door.yaml:1"), HasSubstr("millimetres are meant, write 0.004")));
  EXPECT_THAT(refusal("link_voxel: {bolt: 2}\n"), HasSubstr("write 0.002"));
  EXPECT_THAT(refusal("erosion: 0.5\n"), HasSubstr("write 0.0005"));
  EXPECT_THAT(refusal("pair_erosion:\n- {links: [door, bolt], erosion: 2}\n"),
              HasSubstr("write 0.002"));
  EXPECT_THAT(refusal("initial_state: {position: [0, 0, 700]}\n"), HasSubstr("write 0.7"));
}

TEST_F(LoadModelTest, RefusesPairsThatAreNoPairs) {
  const auto pair = [&](const std::string& content) {
    return refusal("pair_erosion:\n- {" + content + "}\n");
  };
  EXPECT_THAT(pair("links: [door, knob], erosion: 0.001"), HasSubstr("door.yaml:2: the two links"));
  EXPECT_THAT(pair("links: [door], erosion: 0.001"), HasSubstr("a list of 2"));
  EXPECT_THAT(pair("links: [door, bolt]"), HasSubstr("both keys"));
  EXPECT_THAT(pair("link: [door, bolt], erosion: 0.001"), HasSubstr("unknown key 'link'"));
  EXPECT_THAT(refusal("pair_erosion:\n- {links: [door, bolt], erosion: 0}\n"
                      "- {links: [bolt, knob], erosion: 0}\n"),
              HasSubstr("door.yaml:3: the pair"));
}

TEST_F(LoadModelTest, RefusesInitialStatesThatCannotBe) {
  const auto state = [&](const std::string& content) {
    return refusal("initial_state: {" + content + "}\n");
  };
  EXPECT_THAT(state("quaternion: [0, 0, 0, 2]"), HasSubstr("norm 2"));
  EXPECT_THAT(state("position: [0, 0]"), HasSubstr("a list of 3"));
  EXPECT_THAT(state("joints: {door: 1}"), HasSubstr("there are"));
  EXPECT_THAT(state("joints: {shadow: 1}"), HasSubstr("it mimics; set 'slide'"));
  EXPECT_THAT(state("joints: {hinge: 2}"), HasSubstr("moves between -1 and 1"));
  EXPECT_THAT(state("pose: 1"), HasSubstr("unknown key 'pose'"));
}

}  // namespace
}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "urdf_test.hpp"

namespace lockbox {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

Eigen::Isometry3d translation(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

using LoadKinematicTree = UrdfTest;

TEST_F(LoadKinematicTree, ReadsEveryJointTypeWithItsLimits) {
  const KinematicTree tree =
      load_robot(link("base", box("1 1 1")) + link("a") + link("b") + link("c") +
                 joint("turn", "revolute", "base", "a",
                       "<axis xyz=\"0 0 2\"/><limit lower=\"-0.5\" upper=\"1.5\" effort=\"1\"/>") +
                 joint("spin", "continuous", "a", "b", "<axis xyz=\"0 3 4\"/>") +
                 joint("slide", "prismatic", "b", "c", "<limit upper=\"0.25\"/>"));
  ASSERT_EQ(tree.joints.size(), 3U);
  EXPECT_EQ(tree.variables(), 3);
  const Joint& turn = tree.joints[0];
  EXPECT_EQ(turn.type, JointType::revolute);
  EXPECT_EQ(turn.axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(turn.lower, -0.5);
  EXPECT_EQ(turn.upper, 1.5);
  const Joint& spin = tree.joints[1];
  EXPECT_EQ(spin.type, JointType::continuous);
  EXPECT_TRUE(spin.axis.isApprox(Eigen::Vector3d(0.0, 0.6, 0.8), 1e-15));
  EXPECT_EQ(spin.lower, -std::numeric_limits<double>::infinity());
  const Joint& slide = tree.joints[2];
  EXPECT_EQ(slide.type, JointType::prismatic);
  EXPECT_EQ(slide.axis, Eigen::Vector3d::UnitX());
  EXPECT_EQ(slide.lower, 0.0);
  EXPECT_EQ(slide.upper, 0.25);
}

TEST_F(LoadKinematicTree, MergesFixedJointsIntoOneBody) {
  // knob sits 0.1 above the plate, which sits 0.2 above the door, turned by 90 degrees about z.
  const KinematicTree tree =
      load_robot(link("knob", box("0.02 0.02 0.02")) + link("base") + link("plate") +
                 link("door", box("0.4 0.6 0.02")) + link("latch", box("0.1 0.1 0.1")) +
                 joint("f2", "fixed", "plate", "knob", "<origin xyz=\"0.1 0 0\"/>") +
                 joint("hinge", "revolute", "base", "door", kLimit) +
                 joint("f1", "fixed", "door", "plate",
                       "<origin xyz=\"0 0 0.2\" rpy=\"0 0 1.5707963267948966\"/>") +
                 joint("turn", "continuous", "knob", "latch", "<origin xyz=\"0 0.5 0\"/>"));
  ASSERT_EQ(tree.bodies.size(), 3U);
  const Body& door = tree.bodies[1];
  EXPECT_EQ(door.name, "door");
  EXPECT_THAT(door.links, ElementsAre("door", "knob", "plate"));
  EXPECT_EQ(door.visuals.size(), 2U);
  EXPECT_TRUE(bounds(door.mesh).max().isApprox(Eigen::Vector3d(0.2, 0.3, 0.21), 1e-12));
  EXPECT_EQ(tree.joints[1].parent_body, 1);
  // From plate to knob along the turned x, then along the turned y to the joint.
  EXPECT_TRUE(
      tree.joints[1].T_parent_joint.translation().isApprox(Eigen::Vector3d(-0.5, 0.1, 0.2), 1e-12));
  EXPECT_TRUE(tree.bodies[0].visuals.empty());
}

TEST_F(LoadKinematicTree, PlacesPrimitivesAndMeshesWithOriginAndScale) {
  folder_.write("meshes/part.obj", kTetrahedron);
  const KinematicTree tree = load_robot(link(
      "base",
      "<visual><origin xyz=\"0 0 5\"/><geometry><cylinder radius=\"0.5\" length=\"2\"/></geometry>"
      "</visual><visual><origin xyz=\"3 0 0\"/><geometry><sphere radius=\"0.5\"/></geometry>"
      "</visual><visual><origin xyz=\"0 -4 0\"/><geometry><mesh filename=\"meshes/part.obj\" "
      "scale=\"0.1 0.2 0.3\"/></geometry></visual>"));
  ASSERT_EQ(tree.bodies.size(), 1U);
  EXPECT_EQ(tree.bodies[0].visuals.size(), 3U);
  const Eigen::AlignedBox3d box = bounds(tree.bodies[0].mesh);
  EXPECT_NEAR(box.max().x(), 3.5, 1e-9);
  EXPECT_NEAR(box.max().z(), 6.0, 1e-9);
  EXPECT_NEAR(box.min().y(), -4.0, 1e-9);
  for (const ColoredMesh& visual : tree.bodies[0].visuals) {
    if (visual.mesh.vertices.size() != 4) continue;
    EXPECT_TRUE(bounds(visual.mesh).sizes().isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-6));
  }
}

TEST_F(LoadKinematicTree, TakesColoursFromMaterialsInlineNamedAndShared) {
  const auto colored = [](const std::string& size, const std::string& material) {
    return "<visual><geometry><box size=\"" + size + "\"/></geometry>" + material + "</visual>";
  };
  const KinematicTree tree = load_robot(
      "<material name=\"red\"><color rgba=\"1 0 0 1\"/></material>" +
      link("a", colored("1 1 1", "<material name=\"red\"/>")) +
      link("b", colored("1 1 1", "<material name=\"own\"><color rgba=\"0 1 0 0.5\"/></material>")) +
      link("c", colored("1 1 1", "<material name=\"own\"/>")) + link("d", box("1 1 1")) +
      joint("1", "continuous", "a", "b") + joint("2", "continuous", "b", "c") +
      joint("3", "continuous", "c", "d"));
  EXPECT_EQ(tree.bodies[0].visuals[0].rgba, Eigen::Vector4f(1.0F, 0.0F, 0.0F, 1.0F));
  EXPECT_EQ(tree.bodies[1].visuals[0].rgba, Eigen::Vector4f(0.0F, 1.0F, 0.0F, 0.5F));
  EXPECT_EQ(tree.bodies[2].visuals[0].rgba, Eigen::Vector4f(0.0F, 1.0F, 0.0F, 0.5F));
  EXPECT_EQ(tree.bodies[3].visuals[0].rgba, ColoredMesh{}.rgba);
}

TEST_F(LoadKinematicTree, FindsMeshesInPackagesFoldersAboveAndByAddress) {
  const auto loads = [&](const std::string& address, const LoadOptions& options = {}) {
    const std::string text =
        "<robot name=\"r\">" +
        link("base", "<visual><geometry><mesh filename=\"" + address + "\"/></geometry></visual>") +
        "</robot>";
    return load_kinematic_tree(folder_.write("box/urdf/model.urdf", text), options)
               .bodies[0]
               .mesh.triangles.size() == 4;
  };
  const auto above = folder_.write("box/meshes/above.obj", kTetrahedron);
  folder_.write("elsewhere/other/meshes/far.obj", kTetrahedron);
  EXPECT_TRUE(loads("package://box/meshes/above.obj"));
  EXPECT_TRUE(loads("meshes/above.obj"));
  EXPECT_TRUE(loads("../meshes/above.obj"));
  EXPECT_TRUE(loads("file://" + above.string()));
  EXPECT_TRUE(loads(above.string()));
  EXPECT_THROW(loads("package://other/meshes/far.obj"), InputError);
  LoadOptions options;
  options.package_paths = {folder_ / "elsewhere"};
  EXPECT_TRUE(loads("package://other/meshes/far.obj", options));
  options.package_paths = {folder_ / "elsewhere/other"};
  EXPECT_TRUE(loads("package://other/meshes/far.obj", options));
  ASSERT_EQ(setenv("ROS_PACKAGE_PATH", ("/nowhere:" + (folder_ / "elsewhere").string()).c_str(), 1),
            0);
  EXPECT_TRUE(loads("package://other/meshes/far.obj"));
  unsetenv("ROS_PACKAGE_PATH");
}

/// Where packages of ROS 2 and of colcon's workspaces are installed.
TEST_F(LoadKinematicTree, FindsMeshesOfInstalledPackages) {
  folder_.write("prefix/share/shelf/meshes/part.obj", kTetrahedron);
  const auto urdf = folder_.write(
      "model/model.urdf",
      "<robot name=\"r\">" +
          link("a",
               "<visual><geometry><mesh filename=\"package://shelf/meshes/part.obj\"/>"
               "</geometry></visual>") +
          "</robot>");
  EXPECT_THROW(load_kinematic_tree(urdf), InputError);
  const std::string prefixes = "/opt/nowhere::" + (folder_ / "prefix").string();
  for (const char* variable : {"AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) {
    ASSERT_EQ(setenv(variable, prefixes.c_str(), 1), 0);
    EXPECT_NO_THROW(load_kinematic_tree(urdf)) << variable;
    unsetenv(variable);
  }
}

/// A clone is often called otherwise than the package in it.
TEST_F(LoadKinematicTree, FindsPackagesByTheirManifest) {
  folder_.write("shelf-main/meshes/part.obj", kTetrahedron);
  folder_.write("shelf-main/package.xml",
                "<?xml version=\"1.0\"?><package format=\"3\"><name>shelf</name></package>");
  const auto urdf = folder_.write(
      "shelf-main/urdf/model.urdf",
      "<robot name=\"r\">" +
          link("a",
               "<visual><geometry><mesh filename=\"package://shelf/meshes/part.obj\"/>"
               "</geometry></visual>") +
          "</robot>");
  EXPECT_EQ(load_kinematic_tree(urdf).bodies[0].mesh.triangles.size(), 4U);
}

TEST_F(LoadKinematicTree, ComposesChainsOfMimics) {
  // c = 2 b + 0.1, b = -3 a + 0.5, so c = -6 a + 1.1.
  const std::string wide = "<limit lower=\"-9\" upper=\"9\"/>";
  const KinematicTree tree =
      load_robot(link("base") + link("la") + link("lb") + link("lc") +
                 joint("c", "revolute", "lb", "lc",
                       wide + "<mimic joint=\"b\" multiplier=\"2\" offset=\"0.1\"/>") +
                 joint("b", "revolute", "la", "lb",
                       wide + "<mimic joint=\"a\" multiplier=\"-3\" offset=\"0.5\"/>") +
                 joint("a", "revolute", "base", "la", wide));
  EXPECT_EQ(tree.variables(), 1);
  EXPECT_EQ(tree.joints[static_cast<std::size_t>(tree.variable_joint[0])].name, "a");
  Configuration configuration = rest_configuration(tree);
  set_joint_position(tree, configuration, "a", 0.2);
  EXPECT_NEAR(joint_position(tree, configuration, joint_index(tree, "b")), -0.1, 1e-15);
  EXPECT_NEAR(joint_position(tree, configuration, joint_index(tree, "c")), -0.1, 1e-15);
  EXPECT_THROW(set_joint_position(tree, configuration, "c", 0.0), InputError);
  EXPECT_EQ(variable_limits(tree, 0).upper, 9.0);
  const Joint& c = tree.joints[static_cast<std::size_t>(joint_index(tree, "c"))];
  EXPECT_NEAR(c.lower, -6.0 * 9.0 + 1.1, 1e-12);
  EXPECT_NEAR(c.upper, 6.0 * 9.0 + 1.1, 1e-12);
}

TEST_F(LoadKinematicTree, ReadsAChainTwoHundredJointsDeep) {
  const auto numbered = [](std::string stem, int i) { return stem.append(std::to_string(i)); };
  std::string text = link("l0");
  for (int i = 0; i < 200; ++i) {
    text += link(numbered("l", i + 1)) + joint(numbered("j", i), "prismatic", numbered("l", i),
                                               numbered("l", i + 1),
                                               "<origin xyz=\"0 0 0.01\"/>" + std::string(kLimit));
  }
  const KinematicTree tree = load_robot(text);
  ASSERT_EQ(tree.bodies.size(), 201U);
  std::vector<Eigen::Isometry3d> T_camera_body;
  Configuration configuration = rest_configuration(tree);
  configuration.q.setConstant(0.5);
  forward_kinematics(tree, configuration, T_camera_body);
  EXPECT_TRUE(T_camera_body[200].isApprox(translation(100.0, 0.0, 2.0), 1e-12));
}

TEST_F(LoadKinematicTree, ListsJointsInTheOrderOfTheFile) {
  const KinematicTree tree =
      load_robot(link("a") + link("b") + link("c") + joint("inner", "continuous", "b", "c") +
                 joint("outer", "continuous", "a", "b"));
  ASSERT_EQ(tree.file_order.size(), 2U);
  EXPECT_EQ(tree.joints[static_cast<std::size_t>(tree.file_order[0])].name, "inner");
  EXPECT_EQ(tree.joints[0].name, "outer");
}

TEST_F(LoadKinematicTree, SaysOnceThatCollisionGeometryDoesNotCount) {
  const std::string collision = "<collision><geometry><box size=\"1 1 1\"/></geometry></collision>";
  std::vector<std::string> warnings;
  LoadOptions options;
  options.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const KinematicTree tree =
      load_robot(link("a", collision) + link("b", collision) + link("c", box("1 1 1") + collision) +
                     joint("1", "continuous", "a", "b") + joint("2", "continuous", "b", "c"),
                 options);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("'a', 'b'")));
  EXPECT_TRUE(tree.bodies[0].mesh.triangles.empty());
}

TEST_F(LoadKinematicTree, IgnoresWhatOtherProgramsNeed) {
  const KinematicTree tree = load_robot(
      link("a", "<inertial><mass value=\"x\"/></inertial>" + box("1 1 1")) + link("b") +
      joint("j", "continuous", "a", "b", "<dynamics damping=\"x\"/><safety_controller/>") +
      "<transmission name=\"t\"/><gazebo reference=\"a\"><kp>1</kp></gazebo>");
  EXPECT_EQ(tree.joints.size(), 1U);
}

/// Colours are only shown: whatever is wrong with them, the model is the same, but grey.
TEST_F(LoadKinematicTree, IsNotStoppedByColours) {
  const auto rgba_of = [&](const std::string& material, const std::string& top = "") {
    std::vector<std::string> warnings;
    LoadOptions options;
    options.on_warning = [&](const std::string& text) { warnings.push_back(text); };
    const std::string shape = "<geometry><box size=\"1 1 1\"/></geometry>";
    const auto visual = [&](const std::string& more) {
      return "<visual>" + shape + more + "</visual>";
    };
    const KinematicTree tree =
        load_robot(top + link("a", visual(material) + visual(material)), options);
    EXPECT_LE(warnings.size(), 1U);
    return std::pair{tree.bodies[0].visuals[0].rgba, warnings.empty() ? "" : warnings[0]};
  };
  const Eigen::Vector4f grey = ColoredMesh{}.rgba;
  const auto undefined = rgba_of("<material name=\"steel\"/>");
  EXPECT_EQ(undefined.first, grey);
  EXPECT_THAT(undefined.second, HasSubstr("material 'steel' is defined nowhere"));
  for (const std::string rgba : {"0 0 2 1", "red", "1 0 0", ""}) {
    const auto broken = rgba_of("<material name=\"m\"><color rgba=\"" + rgba + "\"/></material>");
    EXPECT_EQ(broken.first, grey) << rgba;
    EXPECT_THAT(broken.second, HasSubstr("model.urdf:2: link 'a': its colour is not read")) << rgba;
  }
  EXPECT_EQ(rgba_of("<material/>").first, grey);
  EXPECT_EQ(rgba_of("<material><texture filename=\"none.png\"/></material>").first, grey);
  const std::string red = "<material name=\"m\"><color rgba=\"1 0 0 1\"/></material>";
  const std::string blue = "<material name=\"m\"><color rgba=\"0 0 1 1\"/></material>";
  EXPECT_EQ(rgba_of("<material name=\"m\"/>", red + blue).first.x(), 1.0F);
  EXPECT_EQ(rgba_of("<material name=\"m\"/>", "<material/>" + blue).first.z(), 1.0F);
  EXPECT_EQ(rgba_of(red + blue).first.x(), 1.0F);
}

TEST_F(LoadKinematicTree, TakesAMeshFileForASingleBody) {
  const KinematicTree tree = load_kinematic_tree(folder_.write("part.OBJ", kTetrahedron));
  ASSERT_EQ(tree.bodies.size(), 1U);
  EXPECT_EQ(tree.name, "part");
  EXPECT_THAT(tree.bodies[0].links, ElementsAre("part"));
  EXPECT_EQ(tree.bodies[0].mesh.triangles.size(), 4U);
  EXPECT_TRUE(tree.joints.empty());
}

TEST(ShippedModels, EveryBodyEnclosesASolid) {
  // What a renderer may leave out then, and a field relies on.
  const std::filesystem::path models = LOCKBOX_MODELS;
  for (const char* name :
       {"board_door_block", "cabinet", "lockbox", "lockbox_overlapping", "rigid_block"}) {
    const KinematicTree tree =
        load_kinematic_tree(models / name / (std::string(name) + ".urdf"), {});
    for (const Body& body : tree.bodies) {
      EXPECT_TRUE(body.encloses_solid) << name << " " << body.name;
    }
  }
}

}  // namespace
}  // namespace lockbox

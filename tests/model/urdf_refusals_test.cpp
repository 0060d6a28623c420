// SPDX-License-Identifier: BSD-3-Clause
// Everything that must not reach urdfdom, or that it lets pass.
#include <gmock/gmock.h>

#include <array>

#include "urdf_test.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

using UrdfRefusals = UrdfTest;

TEST_F(UrdfRefusals, BrokenFiles) {
  EXPECT_THAT(refusal(""), HasSubstr("model.urdf"));
  EXPECT_THAT(refusal("<robot name=\"r\">\n<link name=\"a\"\n"), HasSubstr("not well-formed XML"));
  EXPECT_THAT(refusal("<robot name=\"r\">\n<link name=\"a\">\n</robot>"),
              HasSubstr("model.urdf:2: not well-formed XML"));
  EXPECT_THAT(refusal(std::string("<robot\0 name=\"r\"/>", 18)), HasSubstr("zero byte"));
  EXPECT_THAT(refusal("<sdf version=\"1.6\"/>"), HasSubstr("begins with <robot>, not with <sdf>"));
  EXPECT_THAT(refusal("<robot name=\"r\"/>"), HasSubstr("has no <link>"));
  EXPECT_THAT(refusal("<robot><link name=\"a\"/></robot>"), HasSubstr("the attribute 'name'"));
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(folder_ / "none.urdf"); }),
              HasSubstr("none.urdf: no such file"));
}

TEST_F(UrdfRefusals, FilesOfOtherKindsWithWhatTheyAreAndWhatToDo) {
  const std::vector<std::array<std::string, 4>> files = {
      {"a.oni", "NI10....", "a recording of OpenNI", "--source"},
      {"a.pcd", "# .PCD v.7\n", "a cloud", "--source"},
      {"a.glb", "glTF....", "a glTF mesh", "Blender"},
      {"a.gltf", "{\"asset\": {}}", "a glTF mesh", "Blender"},
      {"a.step", "ISO-10303-21;", "a STEP drawing", "FreeCAD"},
      {"a.yaml", "voxel: 0.004\n", "a text", "give the URDF"},
      {"a.csv", "timestamp,tx\n", "a text", "give the URDF"},
      {"solid.urdf", "solid x\nendsolid x\n", "an STL mesh", ".stl"},
      {"wave.urdf", "v 0 0 0\n", "an OBJ mesh", ".obj"},
      {"a.dae", "<COLLADA/>", "COLLADA", "Blender"},
      {"a.sdf", "<?xml version=\"1.0\"?>\n<sdf version=\"1.6\"/>", "an SDF model", "URDF"},
      {"a.xml", "<mujoco/>", "MuJoCo", "URDF"}};
  for (const auto& [name, content, what, advice] : files) {
    EXPECT_THAT(message_of<InputError>([&, &file = name, &text = content] {
                  load_kinematic_tree(folder_.write(file, text));
                }),
                AllOf(HasSubstr(name), HasSubstr(what), HasSubstr(advice)));
  }
  const std::string robot = "<robot name=\"r\">" + link("a") + "</robot>";
  EXPECT_EQ(load_kinematic_tree(folder_.write("robot.txt", robot)).bodies.size(), 1U)
      << "whatever its name";
}

TEST_F(UrdfRefusals, FilesTooLargeForTheMemory) {
  const auto file = folder_.write("large.urdf", "<robot name=\"r\">");
  std::filesystem::resize_file(file, 600'000'000);  // takes no space on the disk
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(file); }), HasSubstr("512 MB"));
}

TEST_F(UrdfRefusals, EveryTruncationOfAFile) {
  const std::string text = "<robot name=\"r\">" + link("a") + link("b") +
                           joint("j", "continuous", "a", "b") + "</robot>";
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_NE(refusal(text.substr(0, length)), "no error") << "after " << length << " bytes";
  }
}

TEST_F(UrdfRefusals, MacrosWithTheHintToExpandThem) {
  EXPECT_THAT(message_of<InputError>(
                  [&] { load_kinematic_tree(folder_.write("door.urdf.xacro", "<robot/>")); }),
              EndsWith("xacro door.urdf.xacro > door.urdf"));
  EXPECT_THAT(refusal_of_robot(link("a") + "<xacro:door name=\"d\"/>"),
              AllOf(HasSubstr("model.urdf:3"), HasSubstr("expand the file first")));
}

TEST_F(UrdfRefusals, GraphsThatAreNoTree) {
  const std::string abc = link("a") + link("b") + link("c");  // lines 2, 3, 4
  EXPECT_THAT(
      refusal_of_robot(abc + joint("j", "continuous", "a", "b") +
                       joint("k", "continuous", "a", "c") + joint("l", "continuous", "b", "c")),
      AllOf(HasSubstr("model.urdf:7: joint 'l'"), HasSubstr("joint 'k' (line 6)")));
  EXPECT_THAT(refusal_of_robot(abc + joint("j", "continuous", "b", "c") +
                               joint("k", "continuous", "c", "b")),
              HasSubstr("lies on a cycle"));
  EXPECT_THAT(
      refusal_of_robot(abc + joint("j", "continuous", "a", "b") +
                       joint("k", "continuous", "b", "c") + joint("l", "continuous", "c", "a")),
      HasSubstr("lies on a cycle"));
  EXPECT_THAT(refusal_of_robot(abc + joint("j", "continuous", "b", "b")),
              HasSubstr("joint 'j': connects link 'b' with itself"));
  EXPECT_THAT(refusal_of_robot(abc + joint("j", "continuous", "a", "b")),
              HasSubstr("model.urdf:4: link 'c': no joint connects it with link 'a'"));
  EXPECT_THAT(refusal_of_robot(abc + joint("j", "continuous", "a", "door")),
              HasSubstr("there is no link 'door'"));
  EXPECT_THAT(refusal_of_robot(abc + link("b")),
              HasSubstr("model.urdf:5: link 'b': the name is taken by the link in line 3"));
  EXPECT_THAT(refusal_of_robot(abc + joint("j", "continuous", "a", "b") +
                               joint("j", "continuous", "b", "c")),
              HasSubstr("joint 'j': the name is taken by the joint in line 5"));
}

/// A sound robot but for the content of its joint, in line 4.
class JointRefusals : public UrdfTest {
 protected:
  std::string refusal_of(const std::string& type, const std::string& content,
                         const std::string& name = "j") const {
    return refusal_of_robot(link("a") + link("b") + joint(name, type, "a", "b", content));
  }
};

TEST_F(JointRefusals, TypesThatAreNotTracked) {
  EXPECT_THAT(refusal_of("planar", ""),
              HasSubstr("model.urdf:4: joint 'j': type 'planar' is not supported"));
  EXPECT_THAT(refusal_of("floating", ""), HasSubstr("'floating'"));
  EXPECT_THAT(refusal_of("screw", ""), HasSubstr("'screw'"));
}

TEST_F(JointRefusals, AxesWithoutDirection) {
  EXPECT_THAT(refusal_of("continuous", "<axis xyz=\"0 0 0\"/>"), HasSubstr("joint 'j': the axis"));
  EXPECT_THAT(refusal_of("continuous", "<axis/>"), HasSubstr("needs the attribute 'xyz'"));
}

TEST_F(JointRefusals, LimitsThatAreMissingOrInverted) {
  EXPECT_THAT(refusal_of("revolute", ""), HasSubstr("joint 'j': needs <limit"));
  EXPECT_THAT(refusal_of("prismatic", "<limit effort=\"1\"/>"), HasSubstr("needs <limit"));
  EXPECT_THAT(refusal_of("prismatic", "<limit lower=\"1\" upper=\"0\"/>"),
              HasSubstr("the lower limit is above the upper"));
}

TEST_F(JointRefusals, NumbersThatAreNone) {
  for (const std::string number : {"0,12", "nan", "1e400", "inf", "0.1m", "--1", "0x10"}) {
    EXPECT_THAT(refusal_of("continuous", "<origin xyz=\"0 0 " + number + "\"/>"),
                AllOf(HasSubstr("joint 'j'"), HasSubstr("'" + number + "' in attribute 'xyz'")));
  }
  EXPECT_THAT(refusal_of("continuous", "<origin xyz=\"0 0\"/>"), HasSubstr("3 numbers, not 2"));
  EXPECT_THAT(refusal_of("continuous", "<origin rpy=\"0 0 0 0\"/>"), HasSubstr("not 4"));
  EXPECT_THAT(refusal_of("continuous", "<origin xyz=\"0 0 1e300\"/>"), HasSubstr("'xyz'"));
}

TEST_F(JointRefusals, MimicsWithoutADriver) {
  EXPECT_THAT(refusal_of("continuous", "<mimic joint=\"k\"/>"),
              HasSubstr("joint 'j': mimics joint 'k', which does not exist"));
  EXPECT_THAT(refusal_of("continuous", "<mimic joint=\"j\"/>"), HasSubstr("mimics itself"));
  EXPECT_THAT(refusal_of_robot(link("a") + link("b") + link("c") +
                               joint("j", "continuous", "a", "b", "<mimic joint=\"k\"/>") +
                               joint("k", "continuous", "b", "c", "<mimic joint=\"j\"/>")),
              HasSubstr("mimics itself"));
  EXPECT_THAT(refusal_of_robot(link("a") + link("b") + link("c") +
                               joint("j", "continuous", "a", "b", "<mimic joint=\"k\"/>") +
                               joint("k", "fixed", "b", "c")),
              HasSubstr("'k', which is fixed"));
}

TEST_F(JointRefusals, NamesThatNoColumnCanBear) {
  for (const std::string name : {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw", "status",
                                 "residual_rms", "explained", "contradicted", "latency_ms",
                                 "belief", "alternatives", "door.sigma", ".sigma"}) {
    EXPECT_THAT(refusal_of("continuous", "", name), HasSubstr("rename the joint")) << name;
  }
  for (const std::string name : {"a,b", "a&quot;b", "a'b", " door", "door "}) {
    EXPECT_THAT(refusal_of("continuous", "", name), HasSubstr("rename the joint")) << name;
  }
  EXPECT_THAT(refusal_of("continuous", "", "a&#10;b"),
              HasSubstr("the byte 0x0A, which is a control character"));
  EXPECT_THAT(refusal_of("continuous", "", "a\xC3"), HasSubstr("the byte 0xC3"));
  EXPECT_THAT(refusal_of("continuous", "", ""), HasSubstr("needs the attribute 'name'"));
}

/// A sound robot but for one visual, in line 2.
class VisualRefusals : public UrdfTest {
 protected:
  std::string refusal_of(const std::string& geometry, const std::string& more = "") const {
    return refusal_of_robot(link("a", "<visual>" + geometry + more + "</visual>"));
  }
  std::string refusal_of_shape(const std::string& shape) const {
    return refusal_of("<geometry>" + shape + "</geometry>");
  }
};

TEST_F(VisualRefusals, ShapesThatAreMissingUnknownOrEmpty) {
  EXPECT_THAT(refusal_of(""), HasSubstr("model.urdf:2: link 'a': <visual> has no <geometry>"));
  EXPECT_THAT(refusal_of_shape(""), HasSubstr("exactly one shape"));
  EXPECT_THAT(refusal_of_shape("<capsule radius=\"1\"/>"), HasSubstr("<capsule> is unknown"));
  EXPECT_THAT(refusal_of_shape("<box size=\"1 0 1\"/>"), HasSubstr("'size' of <box>"));
  EXPECT_THAT(refusal_of_shape("<box/>"), HasSubstr("needs the attribute 'size'"));
  EXPECT_THAT(refusal_of_shape("<cylinder radius=\"-1\" length=\"1\"/>"), HasSubstr("'radius'"));
  EXPECT_THAT(refusal_of_shape("<sphere radius=\"1e30\"/>"), HasSubstr("'radius'"));
}

TEST_F(VisualRefusals, MeshesThatCannotBeReadNamingTheLink) {
  EXPECT_THAT(refusal_of_shape("<mesh filename=\"none.obj\"/>"),
              AllOf(HasSubstr("model.urdf:2: link 'a': none.obj: no such mesh file"),
                    HasSubstr(folder_.path().string())));
  EXPECT_THAT(refusal_of_shape("<mesh filename=\"http://x/y.obj\"/>"), HasSubstr("only file://"));
  EXPECT_THAT(refusal_of_shape("<mesh filename=\"package://\"/>"), HasSubstr("names no file"));
  EXPECT_THAT(refusal_of_shape("<mesh filename=\"x.obj\" scale=\"1 0 1\"/>"), HasSubstr("'scale'"));
  folder_.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  EXPECT_THAT(refusal_of_shape("<mesh filename=\"bad.obj\"/>"),
              AllOf(HasSubstr("link 'a'"), HasSubstr("bad.obj")));
}

/// A URDF may come from anybody, a symbolic link was made on this machine.
TEST_F(VisualRefusals, AddressesThatLeaveTheirPackage) {
  const std::string solid =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  folder_.write("secret.obj", solid);
  folder_.write("p/a/part.obj", solid);
  folder_.write("p/b/part.obj", solid);
  std::filesystem::create_directory(folder_ / "p/a/x");
  const auto refusal_of_address = [&](const std::string& address) {
    const auto urdf =
        folder_.write("p/m.urdf", "<robot name=\"r\">" +
                                      link("a", "<visual><geometry><mesh filename=\"" + address +
                                                    "\"/></geometry></visual>") +
                                      "</robot>");
    return message_of<InputError>([&] { load_kinematic_tree(urdf); });
  };
  const std::string absolute = (folder_ / "secret.obj").string();
  for (const std::string& address :
       {std::string("package://../secret.obj"), std::string("package://a/../../secret.obj"),
        std::string("package://./../secret.obj"), std::string("package://a/../b/part.obj"),
        std::string("package://a/./../../secret.obj"), std::string("package://.."),
        "package://" + absolute}) {
    EXPECT_THAT(refusal_of_address(address), HasSubstr("leaves its package")) << address;
  }
  EXPECT_EQ(refusal_of_address("package://a/part.obj"), "no error");
  EXPECT_EQ(refusal_of_address("package://a/x/../part.obj"), "no error");
  EXPECT_EQ(refusal_of_address("../secret.obj"), "no error");
  std::filesystem::create_symlink(folder_ / "secret.obj", folder_ / "p/a/linked.obj");
  EXPECT_EQ(refusal_of_address("package://a/linked.obj"), "no error");
}

/// How often the text holds the part.
std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(UrdfRefusals, NameTheMissingPackageAndEachSearchedFolderOnce) {
  const std::string robot =
      link("a", "<visual><geometry><mesh filename=\"package://arms/a.obj\"/></geometry></visual>");
  LoadOptions options;
  options.package_paths = {folder_ / "packages", folder_ / "packages/"};
  const auto refused = [&] { return message_of<InputError>([&] { load_robot(robot, options); }); };
  const std::string missing = refused();
  EXPECT_THAT(missing,
              AllOf(HasSubstr("the package 'arms' is missing"), HasSubstr("--package-path")));
  EXPECT_EQ(count_of((folder_ / "packages").string(), missing), 1U);
  folder_.write("packages/arms/b.obj", "");
  EXPECT_THAT(refused(), AllOf(HasSubstr("no such mesh file in the package 'arms'"),
                               HasSubstr((folder_ / "packages/arms").string())));
  options.package_paths.push_back(folder_ / "packages/arms");  // both holds and is it
  EXPECT_EQ(count_of((folder_ / "packages/arms").string(), refused()), 1U);
}

TEST_F(UrdfRefusals, ReadNoManifestOfAPackageThatClaimsToBeHuge) {
  std::filesystem::resize_file(folder_.write("package.xml", ""), std::uintmax_t{1} << 40);
  EXPECT_THAT(refusal_of_robot(link("a",
                                    "<visual><geometry><mesh filename=\"package://arms/a.obj\"/>"
                                    "</geometry></visual>")),
              HasSubstr("the package 'arms' is missing"));
}

}  // namespace
}  // namespace lockbox

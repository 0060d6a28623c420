// SPDX-License-Identifier: BSD-3-Clause
// Lengths and angles that are in another unit than metres and radians.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "units_fixture.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A box of that size and a part that a hinge moves upon it, 0.3 m aside.
std::string hinged(const std::string& part) {
  return link("base", box("0.5 0.4 0.6")) + part +
         joint("hinge", "revolute", "base", "part", "<origin xyz=\"0.3 0 0\"/>" + limits("0", "1"));
}

TEST_F(Units, OfAMeshInMillimetresAreNamedWithTheFactor) {
  mesh_of(60.0);
  EXPECT_THAT(refusal_of(hinged(mesh_link("part"))),
              AllOf(HasSubstr("model.urdf:3: link 'part': its mesh part.obj is 60 m large"),
                    HasSubstr("in millimetres (then it is 60 mm large)"),
                    HasSubstr("scale=\"0.001 0.001 0.001\""), HasSubstr("--mesh-scale 0.001 for"),
                    HasSubstr("limits of joints are not converted")));
  EXPECT_EQ(warnings_of(hinged(mesh_link("part", "0.001 0.001 0.001"))), "");
  EXPECT_EQ(warnings_of(hinged(mesh_link("part")), 0.001), "");
}

TEST_F(Units, OfABareMeshAreMendedByTheOption) {
  const auto file = mesh_of(380.0);
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(file); }),
              AllOf(HasSubstr("part.obj: the mesh is 380 m large"), HasSubstr("millimetres"),
                    HasSubstr("give --mesh-scale 0.001"), Not(HasSubstr("scale=\"")),
                    Not(HasSubstr("joints"))));
  EXPECT_EQ(warnings_of_mesh(file, 0.001), "");
  const auto micrometres = mesh_of(2e5);
  EXPECT_THAT(
      message_of<InputError>([&] { load_kinematic_tree(micrometres); }),
      AllOf(HasSubstr("micrometres (then it is 200 mm"), HasSubstr("--mesh-scale 0.000001")));
}

TEST_F(Units, OfABareMeshFarFromItsOriginAreToldWithoutWordsOfAUrdf) {
  std::string vertices;
  for (const char* place : {"9 0 0", "9.2 0 0", "9 0.2 0", "9 0 0.2"}) {
    vertices += std::string("v ") + place + "\n";
  }
  const auto file = folder_.write("far.obj", vertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_THAT(warnings_of_mesh(file, 1.0), AllOf(HasSubstr("the mesh lies 9.1 m away"),
                                                 HasSubstr("its origin"), Not(HasSubstr("<"))));
}

TEST_F(Units, AreGuessedByTheOtherLinks) {
  mesh_of(40.0);  // inches of a thing of 1 m; 40 mm beside others of 20 m would be odd
  const std::string others =
      link("base", box("1.1 1.2 0.9")) +
      joint("hinge", "continuous", "base", "part", "<origin xyz=\"1 0 0\"/>");
  EXPECT_THAT(refusal_of(others + mesh_link("part")), HasSubstr("millimetres"));
  mesh_of(12.0);
  EXPECT_THAT(warnings_of(others + mesh_link("part")), HasSubstr("large"));
  const std::string large = link("base", box("5 5 5")) +
                            joint("hinge", "continuous", "base", "part", "<origin xyz=\"4 0 0\"/>");
  mesh_of(300.0);
  EXPECT_THAT(refusal_of(large + mesh_link("part")), HasSubstr("millimetres (then it is 300 mm"));
  mesh_of(30.0);
  EXPECT_THAT(refusal_of(large + mesh_link("part")),
              AllOf(HasSubstr("centimetres (then it is 300 mm"), HasSubstr("--mesh-scale 0.01 ")));
}

/// A cabinet of half a metre, or a matchbox: only who drew it knows.
TEST_F(Units, AreBothNamedWhereTheyCannotBeTold) {
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(mesh_of(50.0)); }),
              AllOf(HasSubstr("in millimetres (then it is 50 mm large): give --mesh-scale 0.001"),
                    HasSubstr("or it is in centimetres (then it is 500 mm large): "
                              "--mesh-scale 0.01")));
  const std::string drawer = mesh_link("base") + mesh_link("drawer") +
                             joint("slide", "prismatic", "base", "drawer",
                                   "<origin xyz=\"0.2 0 0.15\"/>" + limits("0", "0.3"));
  EXPECT_THAT(refusal_of(drawer), AllOf(HasSubstr("millimetres"),
                                        HasSubstr("or it is in centimetres (then it is 500 mm "
                                                  "large): scale=\"0.01 0.01 0.01\"")));
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(mesh_of(380.0)); }),
              Not(HasSubstr("centimetres")));
}

TEST_F(Units, OfAMeshScaledThoughItIsInMetresAreToldTheOpposite) {
  mesh_of(0.6);
  EXPECT_THAT(
      warnings_of(hinged(mesh_link("part", "0.001 0.001 0.001"))),
      AllOf(HasSubstr("link 'part': its mesh part.obj is 600 um large"),
            HasSubstr("in metres already (then it is 600 mm large): leave out scale=\"0.001"),
            Not(HasSubstr("millimetres"))));
  EXPECT_THAT(warnings_of_mesh(folder_ / "part.obj", 0.001),
              HasSubstr("leave out --mesh-scale 0.001"));
  mesh_of(60.0);
  EXPECT_THAT(warnings_of(hinged(mesh_link("part", "1e-6 1e-6 1e-6"))),
              AllOf(HasSubstr("its file seems to be in millimetres (then it is 60 mm"),
                    HasSubstr("write scale=\"0.001 0.001 0.001\"")));
  mesh_of(0.4);
  EXPECT_THAT(refusal_of(hinged(mesh_link("part", "1000 1000 1000"))),
              AllOf(HasSubstr("400 m large"), HasSubstr("in metres already (then it is 400 mm"),
                    HasSubstr("leave out scale=\"1000"), Not(HasSubstr("millimetres"))));
  mesh_of(0.00006);
  EXPECT_THAT(warnings_of(hinged(mesh_link("part"))),
              AllOf(HasSubstr("60 um large"), HasSubstr("scale=\"1000 1000 1000\"")));
}

TEST_F(Units, OfManyLinksAreNamedOnce) {
  mesh_of(12.0);
  const std::string warnings =
      warnings_of(link("base", box("0.5 0.4 0.6")) + mesh_link("x") + mesh_link("y") +
                  mesh_link("z") + joint("j", "continuous", "base", "x") +
                  joint("k", "continuous", "base", "y") + joint("l", "continuous", "base", "z"));
  EXPECT_THAT(warnings, HasSubstr("its mesh part.obj is 12 m large"));
  EXPECT_THAT(warnings, HasSubstr("(and 2 more like it)"));
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), '\n'), 1) << warnings;
}

TEST_F(Units, OfPrimitivesAreMendedByHand) {
  EXPECT_THAT(refusal_of(link("a", box("400 300 200"))),
              AllOf(HasSubstr("model.urdf:2: link 'a': its <box> is 400 m large"),
                    HasSubstr("millimetres"), HasSubstr("0.001 times"), Not(HasSubstr("scale="))));
}

TEST_F(Units, OutOfProportionAreNamedThoughTheyWouldBeSeen) {
  mesh_of(8.0);
  EXPECT_THAT(
      warnings_of(link("base", box("0.2 0.1 0.1")) + mesh_link("screw") +
                  joint("turn", "continuous", "base", "screw", "<origin xyz=\"0.1 0 0\"/>")),
      AllOf(HasSubstr("link 'screw': its mesh"), HasSubstr("millimetres (then it is 8 mm")));
}

/// Sizes that occur: a hall, a wardrobe with knobs, a watch.
TEST_F(Units, OfThingsAsTheyAreRaiseNoQuestion) {
  EXPECT_EQ(warnings_of(link("a", box("9 6 3"))), "");
  EXPECT_EQ(warnings_of(link("a", box("1.8 0.6 2.2")) + link("b", box("0.03 0.03 0.03")) +
                        joint("j", "revolute", "a", "b",
                              "<origin xyz=\"0 0.3 1\"/>" + limits("-3.1416", "6.2832"))),
            "");
  EXPECT_EQ(warnings_of(link("a", box("0.04 0.04 0.01"))), "");
  EXPECT_EQ(warnings_of(link("world") + link("a", box("0.1 0.1 0.1")) +
                        joint("j", "prismatic", "world", "a",
                              "<origin xyz=\"4 3 0\"/>" + limits("-0.5", "1.5"))),
            "");
}

TEST_F(Units, OfOriginsAreNotTakenForThoseOfMeshes) {
  EXPECT_THAT(
      warnings_of(link("base", box("0.5 0.4 0.6")) + link("door", box("0.3 0.02 0.5")) +
                  joint("hinge", "revolute", "base", "door",
                        "<origin xyz=\"300 0 0\"/>" + limits("0", "1"))),
      AllOf(HasSubstr("model.urdf:4: joint 'hinge': its <origin> puts it 300 m away"),
            HasSubstr("if millimetres are meant, write 0.3 for 300"), Not(HasSubstr("mesh"))));
  EXPECT_THAT(refusal_of(link("base", box("0.5 0.4 0.6")) + link("knob", box("0.05 0.05 0.05")) +
                         joint("glue", "fixed", "base", "knob", "<origin xyz=\"250 0 0\"/>")),
              AllOf(HasSubstr("link 'knob'"), HasSubstr("a fixed joint, puts its geometry 250 m")));
  EXPECT_THAT(warnings_of(link("a", box("0.5 0.4 0.6", "<origin xyz=\"0 0 250\"/>"))),
              HasSubstr("link 'a': its <origin>"));
}

TEST_F(Units, OfLimitsInDegreesAreNamedWithTheRadians) {
  const auto warning = [&](const std::string& lower, const std::string& upper) {
    return warnings_of(link("a", box("1 1 1")) + link("b") +
                       joint("h", "revolute", "a", "b", limits(lower, upper)));
  };
  EXPECT_THAT(warning("0", "110"),
              AllOf(HasSubstr("model.urdf:4: joint 'h': its limits, 0 to 110, are in radians"),
                    HasSubstr("6303 degrees"), HasSubstr("write 0 to 1.92")));
  EXPECT_THAT(warning("-45", "45"), HasSubstr("write -0.7854 to 0.7854"));
  EXPECT_THAT(warning("0", "10"), HasSubstr("degrees"));
  EXPECT_THAT(warning("-1e16", "1e16"), HasSubstr("continuous"));
  for (const std::string turn :
       {"1.5708", "3.1416", "6.2831853", "6.98132", "9.42478", "12.5664"}) {
    EXPECT_THAT(warning("-" + turn, turn), IsEmpty()) << turn;
  }
}

TEST_F(Units, OfAnglesOfOriginsInDegreesAreNamedWithTheRadians) {
  const auto warning = [&](const std::string& rpy) {
    return warnings_of(link("a", box("1 1 1")) + link("b") +
                       joint("h", "continuous", "a", "b", "<origin rpy=\"" + rpy + "\"/>"));
  };
  EXPECT_THAT(warning("0 0 -90"),
              AllOf(HasSubstr("model.urdf:4: joint 'h': 'rpy' holds -90, and is in radians"),
                    HasSubstr("write -1.5708")));
  EXPECT_EQ(warning("1.5708 -3.14159 6.28319"), "");
  EXPECT_THAT(warnings_of(link("a", box("1 1 1", "<origin rpy=\"0 180 0\"/>"))),
              HasSubstr("link 'a': 'rpy' holds 180"));
}

TEST_F(Units, OfTravelInMillimetresAreNamedWithTheMetres) {
  const auto warning = [&](const std::string& upper) {
    return warnings_of(link("a", box("0.2 0.1 0.1")) + link("b") +
                       joint("s", "prismatic", "a", "b", limits("0", upper)));
  };
  EXPECT_THAT(warning("50"), AllOf(HasSubstr("joint 's': its limits, 0 to 50, are in metres"),
                                   HasSubstr("millimetres are meant, write 0 to 0.05"),
                                   HasSubstr("--mesh-scale converts meshes alone")));
  EXPECT_THAT(warning("400"), HasSubstr("write 0 to 0.4"));
  EXPECT_THAT(warning("1e9"), HasSubstr("give the range"));
  EXPECT_EQ(warning("2"), "");
}

TEST_F(Units, OfMeshesMustBePositive) {
  const auto file = mesh_of(1.0);
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(message_of<InputError>([&] { warnings_of_mesh(file, scale); }),
                HasSubstr("positive"));
  }
}

/// Limits of 0 and 0 are what some programs export for what they do not know.
TEST_F(Units, OrNotJointsThatCannotMoveAreNamed) {
  EXPECT_THAT(warnings_of(link("a", box("1 1 1")) + link("b") +
                          joint("h", "revolute", "a", "b", limits("0", "0"))),
              HasSubstr("model.urdf:4: joint 'h': it cannot move: its limits are 0 to 0"));
}

TEST(ModelFolder, IsAnsweredWithTheModelsInIt) {
  const auto folder = std::filesystem::path(LOCKBOX_MODELS) / "cabinet";
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(folder); }),
              AllOf(HasSubstr("a folder is no model"), HasSubstr("cabinet.urdf")));
  EXPECT_THAT(message_of<InputError>([&] { load_kinematic_tree(LOCKBOX_MODELS); }),
              HasSubstr("it holds no .urdf"));
}

}  // namespace
}  // namespace lockbox

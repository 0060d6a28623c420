// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/scene_composer.hpp"

#include <gmock/gmock.h>

#include "block_model.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Three measurements: 5 mm before the block's front face at 0.95 m, 5 mm behind it, a wall; and
/// one pixel without.
DepthFrame four_pixels() {
  DepthFrame frame;
  frame.camera = {4, 1, 100.0, 100.0, 1.5, 0.0};
  frame.depth = {945, 955, 0, 2000};
  return frame;
}

class SceneComposerTest : public testing::Test {
 protected:
  const DisplayedScene& compose(const Configuration& configuration, const SceneChoices& choices) {
    return composer_.compose(&frame_, configuration, "title", choices);
  }

  std::vector<int> color_of(const DisplayedScene& scene, std::ptrdiff_t point) const {
    return {scene.point_rgb.begin() + 3 * point, scene.point_rgb.begin() + 3 * point + 3};
  }

  const ArticulatedModel model_ = block_model();
  const DepthFrame frame_ = four_pixels();
  SceneComposer composer_{model_, "keys"};
};

TEST_F(SceneComposerTest, PutsMeasuredPixelsIntoSpace) {
  const DisplayedScene& scene = compose(one_metre_away(), {});
  ASSERT_THAT(scene.points, SizeIs(3));
  EXPECT_LT((scene.points[2] - Eigen::Vector3f(0.03F, 0.0F, 2.0F)).norm(), 1e-5F);
  EXPECT_THAT(scene.point_rgb, SizeIs(9));
  EXPECT_THAT(scene.T_camera_body, SizeIs(1));
  EXPECT_THAT(scene.scale, IsEmpty());
}

TEST_F(SceneComposerTest, PlacesAlternativesAndNamesThemInTheLegend) {
  ShownEstimate estimate(one_metre_away());
  Configuration elsewhere = one_metre_away();
  elsewhere.T_camera_base.pretranslate(Eigen::Vector3d(0.1, 0.0, 0.0));
  estimate.alternatives = {{alternative_name("flip", 0.3), one_metre_away()},
                           {alternative_name("elsewhere", 0.02), elsewhere}};
  SceneChoices choices;
  const DisplayedScene& scene = composer_.compose(&frame_, estimate, "title", choices);
  ASSERT_THAT(scene.ghosts, SizeIs(2));
  EXPECT_NEAR(scene.ghosts[1].T_camera_body[0].translation().x(),
              scene.T_camera_body[0].translation().x() + 0.1, 1e-9);
  ASSERT_THAT(scene.legend, SizeIs(2));
  EXPECT_EQ(scene.legend[0].name, "flip 30 %");
  EXPECT_EQ(scene.legend[1].color, scene.ghosts[1].color);
  EXPECT_NE(scene.ghosts[0].color, scene.ghosts[1].color);
  EXPECT_TRUE(choices.handle("a"));
  EXPECT_THAT(composer_.compose(&frame_, estimate, "title", choices).ghosts, IsEmpty());
  EXPECT_THAT(scene.legend, IsEmpty());
}

TEST_F(SceneComposerTest, ColorsErrorsBlueBeforeRedBehindGreyBeyond) {
  SceneChoices choices;
  choices.coloring = Coloring::errors;
  const DisplayedScene& scene = compose(one_metre_away(), choices);
  const auto before = color_of(scene, 0);
  const auto behind = color_of(scene, 1);
  const auto beyond = color_of(scene, 2);
  EXPECT_GT(before[2], before[0] + 50);
  EXPECT_GT(behind[0], behind[2] + 50);
  EXPECT_EQ(beyond[0], beyond[2]);
  EXPECT_LT(scene.model_opacity, 0.5) << "points behind the surface have to be seen";
  EXPECT_FALSE(scene.scale.empty());
}

TEST_F(SceneComposerTest, ShowsTheCloudAloneWhileThePoseIsNotKnown) {
  SceneChoices choices;
  choices.coloring = Coloring::errors;
  const DisplayedScene& scene = compose(unknown_configuration(model_.tree), choices);
  EXPECT_THAT(scene.points, SizeIs(3));
  EXPECT_THAT(scene.T_camera_body, IsEmpty());
  EXPECT_THAT(scene.scale, IsEmpty());
}

TEST_F(SceneComposerTest, TakesColoursBackWithTheKeyThatAskedForThem) {
  SceneChoices choices;
  for (const auto& [key, coloring] :
       {std::pair{"e", Coloring::errors}, std::pair{"b", Coloring::bodies},
        std::pair{"t", Coloring::terms}, std::pair{"u", Coloring::uncertainty}}) {
    EXPECT_TRUE(choices.handle(key));
    EXPECT_EQ(choices.coloring, coloring);
  }
  EXPECT_TRUE(choices.handle("u"));
  EXPECT_EQ(choices.coloring, Coloring::plain);
  EXPECT_TRUE(choices.handle("s"));
  EXPECT_TRUE(choices.beside);
}

TEST_F(SceneComposerTest, OfWhatWasMeasuredHasNoModel) {
  SceneChoices choices;
  choices.coloring = Coloring::errors;
  choices.help = true;
  const DisplayedScene& scene = compose(one_metre_away(), choices.measured_only());
  EXPECT_THAT(scene.points, SizeIs(3));
  EXPECT_THAT(scene.T_camera_body, IsEmpty());
  EXPECT_THAT(scene.scale, IsEmpty());
  EXPECT_THAT(scene.overlay, IsEmpty());
}

TEST_F(SceneComposerTest, SaysHowFarTheEstimateIsBelieved) {
  ShownEstimate estimate(one_metre_away());
  estimate.belief = "belief 97 %";
  EXPECT_THAT(composer_.compose(nullptr, estimate, "title", {}).status,
              HasSubstr("title\nbelief 97 %"));
}

TEST(BeliefLine, NamesTheAlternatives) {
  EXPECT_EQ(belief_line(0.97, ""), "belief 97 %");
  EXPECT_EQ(belief_line(0.6, "flip:0.25;elsewhere:0.1"),
            "belief 60 %; or flip 25 %, elsewhere 10 %");
}

TEST_F(SceneComposerTest, LeavesOutWhatTheUserHasSwitchedOff) {
  SceneChoices choices;
  EXPECT_TRUE(choices.handle("p"));
  EXPECT_TRUE(choices.handle("m"));
  EXPECT_FALSE(choices.handle("space"));
  EXPECT_THAT(compose(one_metre_away(), choices).points, IsEmpty());
  EXPECT_THAT(compose(one_metre_away(), choices).T_camera_body, IsEmpty());
  choices.handle("p");
  EXPECT_THAT(compose(one_metre_away(), choices).points, SizeIs(3));
}

TEST_F(SceneComposerTest, SaysHowTheJointsStand) {
  ArticulatedModel drawer = block_model();
  drawer.tree.bodies.push_back(drawer.tree.bodies[0]);
  drawer.fields.emplace_back(std::nullopt);
  Joint joint;
  joint.name = "drawer";
  joint.type = JointType::prismatic;
  joint.child_body = 1;
  joint.variable = 0;
  drawer.tree.joints = {joint};
  drawer.tree.variable_joint = {0};
  drawer.tree.file_order = {0};
  auto configuration = one_metre_away();
  configuration.q = Eigen::VectorXd::Constant(1, 0.0123);
  SceneComposer composer(drawer, "");
  const DisplayedScene& scene = composer.compose(nullptr, configuration, "title", {});
  EXPECT_THAT(scene.status, HasSubstr("title\n"));
  EXPECT_THAT(scene.status, HasSubstr("drawer    12.3 mm"));
}

TEST_F(SceneComposerTest, ExplainsTheKeysWhereTheUserAsks) {
  SceneChoices choices;
  EXPECT_THAT(compose(one_metre_away(), choices).overlay, IsEmpty());
  EXPECT_THAT(compose(one_metre_away(), choices).help, HasSubstr("h help"));
  EXPECT_TRUE(choices.handle("h"));
  EXPECT_THAT(compose(one_metre_away(), choices).overlay, HasSubstr("keys"));
  choices.handle("h");
  EXPECT_THAT(compose(one_metre_away(), choices).overlay, IsEmpty());
  SceneComposer silent(model_, "");
  EXPECT_THAT(silent.compose(nullptr, one_metre_away(), "", {}).help, IsEmpty()) << "in pictures";
}

TEST(CameraNearSensor, LooksAtWhatIsMeasuredFromTheSideOfTheSensor) {
  const SceneCamera camera = camera_near_sensor(four_pixels());
  EXPECT_NEAR(camera.target.z(), 0.955, 1e-6);
  EXPECT_LT(camera.eye.norm(), 0.5);
  EXPECT_LT(camera.up.y(), 0.0);
}

}  // namespace
}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/state_line.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lockbox/model/states_file.hpp"

namespace lockbox {
namespace {

using nlohmann::json;

/// A door, a handle that mimics it at half the angle and the other way round, and a drawer. The
/// file has the drawer first.
KinematicTree cabinet() {
  KinematicTree tree;
  tree.bodies.resize(4);
  tree.joints.resize(3);
  tree.joints[0].name = "door";
  tree.joints[0].variable = 0;
  tree.joints[1].name = "handle \"of\" it";
  tree.joints[1].variable = 0;
  tree.joints[1].is_mimic = true;
  tree.joints[1].multiplier = -0.5;
  tree.joints[2].name = "drawer";
  tree.joints[2].type = JointType::prismatic;
  tree.joints[2].variable = 1;
  tree.variable_joint = {0, 2};
  tree.file_order = {2, 0, 1};
  return tree;
}

TrackingResult tracked() {
  TrackingResult result;
  result.stamp = 12.345678901;
  result.status = TrackingStatus::tracking;
  result.configuration.T_camera_base =
      Eigen::Translation3d(0.1, -0.2, 1.25) *
      Eigen::AngleAxisd(0.5 * std::acos(-1.0), Eigen::Vector3d::UnitZ());
  result.configuration.q = Eigen::Vector2d(0.4, 0.07);
  result.covariance = Eigen::MatrixXd::Zero(8, 8);
  for (int i = 0; i < 8; ++i) result.covariance(i, i) = (i + 1.0) * (i + 1.0);
  result.sigma = result.covariance.diagonal().cwiseSqrt();
  result.observable.assign(8, true);
  result.observable[7] = false;  // the drawer
  return result;
}

TEST(StateLine, HasTheFieldsOfRosMessagesInTheOrderOfTheFile) {
  const auto line = state_line(cabinet(), 17, tracked());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const json state = json::parse(line);
  EXPECT_EQ(state["header"]["stamp"], 12.345678901);
  EXPECT_EQ(state["header"]["frame_id"], "camera_depth_optical_frame");
  EXPECT_EQ(state["frame"], 17);
  EXPECT_EQ(state["status"], "tracking");
  EXPECT_EQ(state["name"], json({"drawer", "door", "handle \"of\" it"}));
  EXPECT_EQ(state["position"], json({0.07, 0.4, -0.2}));
  EXPECT_EQ(state["sigma"], json({nullptr, 7.0, 3.5})) << "not determined: null";
  EXPECT_EQ(state["pose"]["pose"]["position"], json({{"x", 0.1}, {"y", -0.2}, {"z", 1.25}}));
  EXPECT_NEAR(state["pose"]["pose"]["orientation"]["z"].get<double>(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(state["pose"]["pose"]["orientation"]["w"].get<double>(), std::sqrt(0.5), 1e-12);
}

TEST(StateLine, HasTheQuaternionOfStatesFiles) {
  auto result = tracked();
  result.configuration.T_camera_base.linear() =
      Eigen::AngleAxisd(-2.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  ASSERT_LT(Eigen::Quaterniond(result.configuration.T_camera_base.linear()).w(), 0.0);
  const json state = json::parse(state_line(cabinet(), 0, result));
  const auto& q = state["pose"]["pose"]["orientation"];
  std::istringstream row(states_row(cabinet(), 0.0, result.configuration));
  std::vector<double> fields;
  for (std::string field; std::getline(row, field, ',');) fields.push_back(std::stod(field));
  EXPECT_EQ(std::vector<double>({q["x"], q["y"], q["z"], q["w"]}),
            std::vector<double>(fields.begin() + 4, fields.begin() + 8));
}

TEST(StateLine, HasTheCovarianceAboutTheAxesOfTheCamera) {
  // A quarter turn about z: what the base calls x is the camera's y.
  const json state = json::parse(state_line(cabinet(), 0, tracked()));
  const auto covariance = state["pose"]["covariance"].get<std::vector<double>>();
  ASSERT_EQ(covariance.size(), 36);
  const std::vector<double> expected = {4, 1, 9, 25, 16, 36};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(covariance[6 * i + j], i == j ? expected[i] : 0.0, 1e-9) << i << ' ' << j;
    }
  }
}

TEST(StateLine, IsNullWhereNothingIsKnown) {
  auto result = tracked();
  for (const auto status : {TrackingStatus::initializing, TrackingStatus::lost}) {
    result.status = status;
    const json state = json::parse(state_line(cabinet(), 0, result));
    const json nothing = {nullptr, nullptr, nullptr};
    EXPECT_EQ(state["status"], to_string(status));
    EXPECT_EQ(state["name"].size(), 3);
    EXPECT_EQ(state["position"], nothing);
    EXPECT_EQ(state["sigma"], nothing);
    EXPECT_EQ(state["pose"]["pose"]["position"]["x"], nullptr);
    EXPECT_EQ(state["pose"]["pose"]["orientation"]["w"], nullptr);
    EXPECT_EQ(state["pose"]["covariance"], nullptr);
  }
}

TEST(StateLine, HasTheApparentSizeOnceItWasMeasured) {
  auto result = tracked();
  EXPECT_EQ(json::parse(state_line(cabinet(), 0, result)).at("apparent_size"), nullptr);
  result.size.value = {1.0625, 1.03125};
  result.size.covariance = Eigen::Vector2d(0.25 * 0.25, 0.5 * 0.5).asDiagonal();
  json size = {{"across", 1.0625},
               {"across_sigma", 0.25},
               {"along", 1.03125},
               {"along_sigma", 0.5},
               {"is_implausible", false}};
  EXPECT_EQ(json::parse(state_line(cabinet(), 0, result))["apparent_size"], size);
  result.size.covariance(0, 0) = 0.0;
  size["across_sigma"] = 0.0;
  size["is_implausible"] = true;
  EXPECT_EQ(json::parse(state_line(cabinet(), 0, result))["apparent_size"], size);
}

TEST(StateLine, OfARigidObjectHasEmptyLists) {
  KinematicTree tree;
  tree.bodies.resize(1);
  TrackingResult result;
  const json state = json::parse(state_line(tree, 0, result));
  EXPECT_EQ(state["name"], json::array());
  EXPECT_EQ(state["position"], json::array());
  EXPECT_EQ(state["sigma"], json::array());
}

}  // namespace
}  // namespace lockbox

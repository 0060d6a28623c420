// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/state_line.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lockbox/model/told_rotation.hpp"
#include "lockbox/tracking/reported.hpp"

namespace lockbox {
namespace {

using Json = nlohmann::ordered_json;

/// Of REP 103's frames that of the depth camera, as ROS's drivers call it.
constexpr auto kFrameId = "camera_depth_optical_frame";

/// JSON knows neither NaN nor infinity.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// ROS turns about the axes of the camera's frame through the base's origin, and moves along them;
/// the tracker does both along the base's own axes.
Eigen::Matrix<double, 6, 6> covariance_in_camera(const TrackingResult& result) {
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = result.configuration.T_camera_base.linear();
  turn.bottomRightCorner<3, 3>() = result.configuration.T_camera_base.linear();
  return turn * result.covariance.topLeftCorner<6, 6>() * turn.transpose();
}

Json pose_of(const Eigen::Isometry3d& T_camera_base) {
  const Eigen::Vector3d p = T_camera_base.translation();
  const Eigen::Quaterniond r = told_rotation(T_camera_base);
  return {
      {"position", {{"x", number(p.x())}, {"y", number(p.y())}, {"z", number(p.z())}}},
      {"orientation",
       {{"x", number(r.x())}, {"y", number(r.y())}, {"z", number(r.z())}, {"w", number(r.w())}}}};
}

/// Returns the positions of all movable joints.
Json positions_of(const KinematicTree& tree, const Configuration& configuration) {
  Json positions = Json::array();
  for (const int index : tree.file_order) {
    positions.push_back(number(joint_position(tree, configuration, index)));
  }
  return positions;
}

Json alternatives_of(const KinematicTree& tree, const std::vector<Alternative>& alternatives) {
  Json all = Json::array();
  for (const Alternative& alternative : alternatives) {
    all.push_back({{"kind", to_string(alternative.kind)},
                   {"probability", number(alternative.probability)},
                   {"position", positions_of(tree, alternative.configuration)},
                   {"pose", pose_of(alternative.configuration.T_camera_base)}});
  }
  return all;
}

/// Null until it was measured.
Json size_of(const ApparentSize& size) {
  if (!size.covariance.allFinite()) return nullptr;
  const Eigen::Vector2d sigma = size.covariance.diagonal().cwiseSqrt();
  return {{"across", number(size.value[0])},
          {"across_sigma", number(sigma[0])},
          {"along", number(size.value[1])},
          {"along_sigma", number(sigma[1])},
          {"is_implausible", size.is_implausible()}};
}

}  // namespace

std::string state_line(const KinematicTree& tree, std::uint64_t frame,
                       const TrackingResult& result) {
  const bool is_told = is_known(result);
  const Configuration configuration = is_told ? result.configuration : unknown_configuration(tree);
  Json names = Json::array();
  Json sigmas = Json::array();
  for (const int index : tree.file_order) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
    names.push_back(joint.name);
    sigmas.push_back(number(joint_sigma(joint, result)));
  }
  Json covariance = nullptr;
  if (is_told) {
    covariance = Json::array();
    const Eigen::Matrix<double, 6, 6> told = covariance_in_camera(result);
    for (const double value : told.reshaped()) covariance.push_back(number(value));  // symmetric
  }
  const Json line = {
      {"header", {{"stamp", number(result.stamp)}, {"frame_id", kFrameId}}},
      {"frame", frame},
      {"status", to_string(result.status)},
      {"belief", number(result.belief)},
      {"name", names},
      {"position", positions_of(tree, configuration)},
      {"sigma", sigmas},
      {"pose", {{"pose", pose_of(configuration.T_camera_base)}, {"covariance", covariance}}},
      {"alternatives", alternatives_of(tree, result.alternatives)},
      {"apparent_size", size_of(result.size)}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lockbox

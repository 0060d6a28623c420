// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/scene_composer.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/visualization/depth_picture.hpp"
#include "lockbox/visualization/joint_panel.hpp"
#include "lockbox/visualization/model_distance.hpp"

namespace lockbox {
namespace {

constexpr float kErrorRange = 0.01F;  // metres to both sides; what is farther off is grey
constexpr double kFinePoint = 1.0;    // pixels: lets the model show between the points
constexpr double kDensePoint = 2.0;
constexpr double kSeeThrough = 0.35;  // opacity of the model among errors
constexpr auto kScaleTitle = "mm to model\n+ before it\n- behind it\ngrey: more";
constexpr std::uint8_t kGreyBeyond = 95;  // of points that are not near the model

}  // namespace

std::string frame_title(std::size_t index, double stamp, const std::string& word) {
  std::ostringstream title;
  title << "frame " << index << "   " << std::fixed << std::setprecision(2) << stamp << " s   "
        << word;
  return title.str();
}

bool SceneChoices::handle(const std::string& key) {
  if (key == "p") {
    points = !points;
  } else if (key == "m") {
    model = !model;
  } else if (key == "e") {
    errors = !errors;
  } else if (key == "h") {
    help = !help;
  } else {
    return false;
  }
  return true;
}

std::vector<ScenePart> SceneComposer::parts() const {
  std::vector<ScenePart> parts;
  for (std::size_t body = 0; body < model_.tree.bodies.size(); ++body) {
    for (const auto& visual : model_.tree.bodies[body].visuals) {
      parts.push_back({&visual.mesh, visual.rgba.head<3>(), body});
    }
  }
  return parts;
}

DisplayedScene& SceneComposer::compose(const DepthFrame* frame, const ShownEstimate& estimate,
                                       const std::string& title, const SceneChoices& choices) {
  place_model(estimate.configuration);
  const bool is_known = !T_camera_body_.empty();
  const bool with_errors = choices.errors && is_known;
  scene_.status = title;
  if (is_known) {
    scene_.status += joint_panel(model_.tree, estimate.configuration, estimate.sigma);
  }
  scene_.help = help_.empty() || choices.help ? "" : "h help   q close";
  scene_.overlay = choices.help ? "\n" + help_ : "";
  scene_.points.clear();
  scene_.point_rgb.clear();
  if (frame != nullptr && choices.points) {
    place_points(*frame);
    if (with_errors) color_points_by_distance();
  }
  scene_.point_size = with_errors ? kDensePoint : kFinePoint;
  scene_.scale_title = kScaleTitle;
  scene_.scale = with_errors ? distance_scale(kErrorRange) : std::vector<ScaleColor>{};
  scene_.model_opacity = with_errors ? kSeeThrough : 1.0;
  scene_.sliders.clear();
  scene_.seek_bar.reset();
  scene_.T_camera_body = choices.model ? T_camera_body_ : std::vector<Eigen::Isometry3d>{};
  return scene_;
}

void SceneComposer::place_model(const Configuration& configuration) {
  if (configuration.T_camera_base.matrix().allFinite() && configuration.q.allFinite()) {
    forward_kinematics(model_.tree, configuration, T_camera_body_);
  } else {
    T_camera_body_.clear();
  }
}

void SceneComposer::place_points(const DepthFrame& frame) {
  const RgbImage greys = depth_picture(frame);
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const float z = frame.metres(u, v);
      if (z <= 0.0F) continue;
      scene_.points.push_back(
          frame.camera.back_project(u, v, static_cast<double>(z)).cast<float>());
      const auto pixel =
          greys.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{v} * frame.camera.width + u);
      scene_.point_rgb.insert(scene_.point_rgb.end(), pixel, pixel + 3);
    }
  }
}

void SceneComposer::color_points_by_distance() {
  model_distances(model_, T_camera_body_, scene_.points, kErrorRange, distances_);
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    const bool is_near = std::abs(distances_[i]) <= kErrorRange;
    const Eigen::Vector3f color = distance_color(distances_[i], kErrorRange);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = 255.0F * color(static_cast<Eigen::Index>(channel));
      scene_.point_rgb[3 * i + channel] = is_near ? static_cast<std::uint8_t>(value) : kGreyBeyond;
    }
  }
}

}  // namespace lockbox

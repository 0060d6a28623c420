// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/scene_composer.hpp"

#include <array>
#include <iomanip>
#include <sstream>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/visualization/depth_picture.hpp"
#include "lockbox/visualization/joint_panel.hpp"

namespace lockbox {
namespace {

constexpr double kFinePoint = 1.0;  // pixels: lets the model show between the points

/// Red, green, blue in [0, 1]: no colours that points or shipped models have. As many as a tracker
/// reports alternatives; what comes after them begins anew.
const std::array<Eigen::Vector3f, 3> kAlternativeColors{
    Eigen::Vector3f(1.0F, 0.55F, 0.1F), {0.9F, 0.3F, 0.9F}, {0.25F, 0.85F, 0.9F}};

}  // namespace

std::string frame_title(std::size_t index, double stamp, const std::string& word) {
  std::ostringstream title;
  title << "frame " << index << "   " << std::fixed << std::setprecision(2) << stamp << " s   "
        << word;
  return title.str();
}

std::string window_title(const std::string& model, const std::string& shown) {
  std::string title = "lockbox";
  for (const std::string& part : {model, shown}) {
    if (!part.empty()) title += " - " + part;
  }
  return title;
}

bool SceneChoices::handle(const std::string& key) {
  if (key == "p") {
    points = !points;
  } else if (key == "m") {
    model = !model;
  } else if (key == "a") {
    alternatives = !alternatives;
  } else if (key == "s") {
    beside = !beside;
  } else if (key == "h") {
    help = !help;
  } else if (const auto asked = coloring_of_key(key)) {
    coloring = coloring == *asked ? Coloring::plain : *asked;
  } else {
    return false;
  }
  return true;
}

SceneChoices SceneChoices::measured_only() const {
  SceneChoices choices = *this;
  choices.model = false;
  choices.alternatives = false;
  choices.coloring = Coloring::plain;
  choices.help = false;
  return choices;
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
  scene_.status = title;
  if (!estimate.belief.empty()) scene_.status += '\n' + estimate.belief;
  if (is_known) {
    scene_.status += joint_panel(model_.tree, estimate.configuration, estimate.sigma);
  }
  scene_.help = help_.empty() || choices.help ? "" : "h help   q close";
  scene_.overlay = choices.help ? "\n" + help_ : "";
  scene_.points.clear();
  scene_.point_rgb.clear();
  if (frame != nullptr && choices.points) {
    place_points(*frame);
  }
  scene_.point_size = kFinePoint;
  scene_.model_opacity = 1.0;
  scene_.scale.clear();
  scene_.is_scale_logarithmic = false;
  scene_.legend.clear();
  scene_.part_rgb.clear();
  colors_.paint(choices.coloring, frame, estimate, T_camera_body_, scene_);
  scene_.ghosts.clear();
  if (choices.alternatives) place_alternatives(estimate.alternatives);
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

void SceneComposer::place_alternatives(const std::vector<ShownAlternative>& alternatives) {
  for (const ShownAlternative& alternative : alternatives) {
    const auto& color = kAlternativeColors[scene_.ghosts.size() % kAlternativeColors.size()];
    SceneGhost& ghost = scene_.ghosts.emplace_back();
    ghost.color = color;
    forward_kinematics(model_.tree, alternative.configuration, ghost.T_camera_body);
    scene_.legend.push_back({alternative.name, color});
  }
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "scene_pane.hpp"

namespace lockbox {
namespace {

/// So that the estimate shows through, and two of them over each other.
constexpr double kGhostOpacity = 0.35;
constexpr double kTopOfBackground[] = {0.16, 0.18, 0.22};
constexpr double kBottomOfBackground[] = {0.05, 0.06, 0.08};

}  // namespace

ScenePane::ScenePane(const std::vector<ScenePart>& parts, double scale)
    : model_(parts, *renderer_), points_(*renderer_), captions_(*renderer_, scale), scale_(scale) {
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(kBottomOfBackground);
  renderer_->SetBackground2(kTopOfBackground);
  model_.place({}, 1.0);  // where it is, the first scene says
}

void ScenePane::set(const DisplayedScene& scene) {
  points_.set(scene, scale_);
  model_.place(scene.T_camera_body, scene.model_opacity);
  model_.color(scene.part_rgb);
  set_ghosts(scene.ghosts);
  captions_.set(scene);
}

void ScenePane::set_ghosts(const std::vector<SceneGhost>& ghosts) {
  while (ghosts_.size() < ghosts.size()) {
    ghosts_.emplace_back(model_, *renderer_, ghosts[ghosts_.size()].color);
  }
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    const bool is_shown = i < ghosts.size();
    ghosts_[i].place(is_shown ? ghosts[i].T_camera_body : std::vector<Eigen::Isometry3d>{},
                     kGhostOpacity);
  }
}

void ScenePane::extend(double left, double right) {
  renderer_->SetViewport(left, 0.0, right, 1.0);
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// What of a scene the user wants to see.
struct SceneChoices {
  bool points = true;
  bool model = true;
  bool errors = false;  ///< points by their distance to the model, which becomes translucent

  /// Toggles what a key (its name in X11) stands for: `p`, `m`, `e`. False if it is none of them.
  bool handle(const std::string& key);
};

/// Explains the keys of SceneChoices and of the window.
inline constexpr char kSceneHelp[] =
    "e errors   m model   p points   r reset view   mouse turn, shift, zoom   q close";

/// The first line of a status: number and stamp (seconds) of a frame, a word on its estimate.
std::string frame_title(std::size_t index, double stamp, const std::string& word);

/// Puts depth frames and estimates together into scenes.
class SceneComposer {
 public:
  /// The model is referred to, not copied. help: what all scenes say on keys.
  SceneComposer(const ArticulatedModel& model, const std::string& help) : model_(model) {
    scene_.help = help;
  }

  /// The model's parts, for the window.
  std::vector<ScenePart> parts() const;

  /// frame: nothing if it is null. configuration: NaN while the model's pose is not known.
  /// title: the first line of the status. The scene is valid until the next call.
  const DisplayedScene& compose(const DepthFrame* frame, const Configuration& configuration,
                                const std::string& title, const SceneChoices& choices);

 private:
  void place_model(const Configuration& configuration);
  void place_points(const DepthFrame& frame);
  void color_points_by_distance();

  const ArticulatedModel& model_;
  std::vector<Eigen::Isometry3d> T_camera_body_;  ///< empty while they are not known
  std::vector<float> distances_;
  DisplayedScene scene_;
};

/// From near the sensor, so that what it sees is in view and shapes can be told apart.
SceneCamera camera_near_sensor(const DepthFrame& frame);

/// So that the whole model is in view.
SceneCamera camera_before_model(const KinematicTree& tree, const Configuration& configuration);

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// What is known of the model in a frame.
struct ShownEstimate {
  ShownEstimate() = default;
  ShownEstimate(Configuration where, std::vector<double> deviations = {})
      : configuration(std::move(where)), sigma(std::move(deviations)) {}

  Configuration configuration;  ///< NaN while it is not known
  std::vector<double> sigma;    ///< of the joints, by index, radians or metres; empty: not told
};

/// What of a scene the user wants to see.
struct SceneChoices {
  bool points = true;
  bool model = true;
  bool errors = false;  ///< points by their distance to the model, which becomes translucent
  bool help = false;    ///< the keys

  /// Toggles what a key (its name in X11) stands for: `p`, `m`, `e`, `h`. False if it is none of
  /// them.
  bool handle(const std::string& key);
};

/// Explains the keys of SceneChoices and of the window.
inline constexpr char kSceneHelp[] =
    "  e             errors: colours say how far points are from the model\n"
    "  m, p          model, points on and off\n"
    "  r             the view from near the sensor\n"
    "  mouse         turns; with shift it moves, the wheel zooms\n"
    "  h             this help on and off\n"
    "  q             close\n";

/// The first line of a status: number and stamp (seconds) of a frame, a word on its estimate.
std::string frame_title(std::size_t index, double stamp, const std::string& word);

/// Puts depth frames and estimates together into scenes.
class SceneComposer {
 public:
  /// The model is referred to, not copied. help: the lines that explain the keys where they are
  /// asked for; empty: nothing is said of keys.
  SceneComposer(const ArticulatedModel& model, std::string help)
      : model_(model), help_(std::move(help)) {}

  /// The model's parts, for the window.
  std::vector<ScenePart> parts() const;

  /// frame: nothing if it is null. title: the first line of the status. The scene is valid, and may
  /// be added to, until the next call.
  DisplayedScene& compose(const DepthFrame* frame, const ShownEstimate& estimate,
                          const std::string& title, const SceneChoices& choices);

 private:
  void place_model(const Configuration& configuration);
  void place_points(const DepthFrame& frame);
  void color_points_by_distance();

  const ArticulatedModel& model_;
  std::string help_;
  std::vector<Eigen::Isometry3d> T_camera_body_;  ///< empty while they are not known
  std::vector<float> distances_;
  DisplayedScene scene_;
};

/// From near the sensor, so that what it sees is in view and shapes can be told apart.
SceneCamera camera_near_sensor(const DepthFrame& frame);

/// So that the whole model is in view.
SceneCamera camera_before_model(const KinematicTree& tree, const Configuration& configuration);

}  // namespace lockbox

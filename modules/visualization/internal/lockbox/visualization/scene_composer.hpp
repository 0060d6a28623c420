// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/coloring.hpp"
#include "lockbox/visualization/scene_window.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox {

/// What of a scene the user wants to see.
struct SceneChoices {
  bool points = true;
  bool model = true;
  Coloring coloring = Coloring::plain;
  bool alternatives = true;
  bool beside = false;  ///< two scenes side by side
  bool help = false;    ///< the keys

  /// Toggles what a key (its name in X11) stands for: `p`, `m`, `a`, `s`, `h`, and those of
  /// coloring_of_key(). False if it is none of them.
  bool handle(const std::string& key);

  /// What the left one of two scenes shows where they show the same frame: what was measured.
  SceneChoices measured_only() const;
};

/// Explains the keys of SceneChoices for what was measured.
inline constexpr char kPointHelp[] =
    "  e             errors: colours say how far points are from the model\n"
    "  b             bodies: which one is nearest to each point\n"
    "  t             terms: which term of the registration points enter\n"
    "  p             points on and off\n";

/// Explains those for estimates.
inline constexpr char kEstimateHelp[] =
    "  u             uncertainty of where the model's surface is\n"
    "  s             side by side\n"
    "  a             alternatives on and off: where the object may be as well\n";

/// Explains those for any scene, and those of the window.
inline constexpr char kWindowHelp[] =
    "  m             model on and off\n"
    "  r             the view as at the beginning\n"
    "  mouse         turns; with shift it moves, the wheel zooms\n"
    "  h             this help on and off\n"
    "  q             close\n";

/// All of it.
inline std::string scene_help() {
  return std::string(kPointHelp) + kEstimateHelp + kWindowHelp;
}

/// "lockbox - cabinet - out/run": the model, and what of it is shown; empty: the model alone.
std::string window_title(const std::string& model, const std::string& shown);

/// The status of a scene of measured_only().
inline constexpr char kMeasuredTitle[] = "as it was measured";

/// The first line of a status: number and stamp (seconds) of a frame, a word on its estimate.
std::string frame_title(std::size_t index, double stamp, const std::string& word);

/// Puts depth frames and estimates together into scenes.
class SceneComposer {
 public:
  /// The model is referred to, not copied. help: the lines that explain the keys where they are
  /// asked for; empty: nothing is said of keys.
  SceneComposer(const ArticulatedModel& model, std::string help)
      : model_(model), help_(std::move(help)), colors_(model) {}

  /// The model's parts, for the window.
  std::vector<ScenePart> parts() const;

  /// frame: nothing if it is null. title: the first line of the status. The scene is valid, and may
  /// be added to, until the next call.
  DisplayedScene& compose(const DepthFrame* frame, const ShownEstimate& estimate,
                          const std::string& title, const SceneChoices& choices);

 private:
  void place_model(const Configuration& configuration);
  void place_points(const DepthFrame& frame);
  void place_alternatives(const std::vector<ShownAlternative>& alternatives);

  const ArticulatedModel& model_;
  std::string help_;
  std::vector<Eigen::Isometry3d> T_camera_body_;  ///< empty while they are not known
  SceneColors colors_;
  DisplayedScene scene_;
};

/// Returns a view from near the sensor, so that what it sees is in view and shapes can be told
/// apart.
SceneCamera camera_near_sensor(const DepthFrame& frame);

/// So that the whole model is in view.
SceneCamera camera_before_model(const KinematicTree& tree, const Configuration& configuration);

}  // namespace lockbox

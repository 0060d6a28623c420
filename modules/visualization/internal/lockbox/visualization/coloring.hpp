// SPDX-License-Identifier: BSD-3-Clause
// What the colours of a scene say.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/pixel_terms.hpp"
#include "lockbox/visualization/scene_window.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox {

enum class Coloring {
  plain,       ///< points by depth, the model in its own colours
  errors,      ///< points by their distance to the model
  bodies,      ///< points by the body that is nearest, bodies alike
  terms,       ///< points by the term of the registration that they enter
  uncertainty  ///< the model by the standard deviation of where its surface is
};

/// The words of the command line, in the order of the enumeration.
const std::vector<std::string>& coloring_names();

/// Throws InputError if it is none of them.
Coloring coloring_named(const std::string& name);

/// What a key (its name in X11) stands for: `e`, `b`, `t`, `u`.
std::optional<Coloring> coloring_of_key(const std::string& key);

/// Colours scenes, and explains the colours beside them.
class SceneColors {
 public:
  /// The model is referred to, not copied.
  explicit SceneColors(const ArticulatedModel& model) : model_(model), terms_(model) {}

  /// The scene holds the points of the frame (nothing if it is null), row by row, and the bodies
  /// are at these poses.
  void paint(Coloring coloring, const DepthFrame* frame, const ShownEstimate& estimate,
             const std::vector<Eigen::Isometry3d>& T_camera_body, DisplayedScene& scene);

 private:
  void paint_errors(const std::vector<Eigen::Isometry3d>& T_camera_body, DisplayedScene& scene);
  void paint_bodies(const std::vector<Eigen::Isometry3d>& T_camera_body, DisplayedScene& scene);
  void paint_terms(const DepthFrame& frame, const std::vector<Eigen::Isometry3d>& T_camera_body,
                   DisplayedScene& scene);
  void paint_uncertainty(const ShownEstimate& estimate,
                         const std::vector<Eigen::Isometry3d>& T_camera_body,
                         DisplayedScene& scene);
  void remove_points_of_model(const std::vector<Eigen::Isometry3d>& T_camera_body,
                              DisplayedScene& scene);

  const ArticulatedModel& model_;
  PixelTerms terms_;
  std::vector<float> distances_;
  std::vector<int> bodies_;
  std::vector<PixelTerm> term_of_point_;
};

}  // namespace lockbox

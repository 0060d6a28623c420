// SPDX-License-Identifier: BSD-3-Clause
// How well a configuration explains a view, by drawing it: what is measured where the model says
// counts for it, what the camera saw through against it, and a surface that goes on beyond the
// model's contour is not the model's.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "lockbox/core/stop_request.hpp"
#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "view_evidence.hpp"

namespace lockbox {

/// Draws on one thread; reuses its buffers. Tree and view are referred to. Whatever draws throws
/// Stopped if that is requested.
class ViewScore {
 public:
  /// noise: standard deviation of 1/depth of a pixel of the view, 1/metre.
  ViewScore(const KinematicTree& tree, double noise, StopRequest stop_request = nullptr);

  /// Draws what follows into this view. What stands before the object speaks against it while it is
  /// sought, but says nothing about the joints of one that is known to be there.
  void set_view(const CoarseView& view, bool is_known = false);

  /// slack: metres that surfaces may be off. bodies: which to draw, by body; what hides the others
  /// is no matter.
  ViewEvidence evidence(const Configuration& configuration, double slack,
                        const std::vector<std::uint8_t>& bodies);

  /// The larger, the better the whole model fits, for comparing near configurations.
  double fit(const Configuration& configuration, double slack);

  /// The scores of the whole model, up to a constant, for configurations that differ in nothing but
  /// where the moved bodies are. left_out: bodies that are not drawn. Both by body.
  std::vector<double> scan(std::span<const Configuration> trials,
                           const std::vector<std::uint8_t>& moved,
                           const std::vector<std::uint8_t>& left_out, double slack);

 private:
  /// Part of the view, drawn.
  struct Drawing {
    std::unique_ptr<DepthRenderer> renderer;
    RenderedDepth image;
    std::vector<float> scores;  ///< of its pixels, where it shows something
    int left = 0;               ///< of its first pixel in the view
    int top = 0;
  };

  void draw(const Configuration& configuration, const std::vector<std::uint8_t>& bodies,
            Drawing& drawing);
  void draw_bodies(const std::vector<std::uint8_t>& bodies, Drawing& drawing);
  bool frame_motion(std::span<const Configuration> trials, const std::vector<std::uint8_t>& moved,
                    const std::vector<std::uint8_t>& drawn);
  void score_pixels(double slack, Drawing& drawing) const;
  ViewEvidence count_pixels() const;
  double score_of_moved() const;
  double share_in_view(const std::vector<std::uint8_t>& bodies) const;

  const KinematicTree& tree_;
  double noise_;
  StopRequest stop_request_;
  Executor alone_{1};
  const CoarseView* view_ = nullptr;
  bool is_known_ = false;
  double nearest_reach_ = 0.0;  ///< least depth that what the variable moves can have, metres
  std::vector<std::vector<SurfaceSample>> samples_;  ///< by body
  std::vector<Eigen::AlignedBox3d> boxes_;           ///< by body
  BodyPoses poses_;
  std::vector<RenderItem> items_;
  Drawing whole_;
  Drawing moving_;
  Drawing rest_;
};

}  // namespace lockbox

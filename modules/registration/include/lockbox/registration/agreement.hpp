// SPDX-License-Identifier: BSD-3-Clause
// How the visible surface of a registered model compares with the image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/registration/reprojected_view.hpp"
#include "lockbox/registration/visible_surface.hpp"

namespace lockbox {

/// Shares of the visible surface within the image, of the model or of one body; all zero without
/// an image.
struct Agreement {
  double explained = 0.0;     ///< measured where the model says
  double contradicted = 0.0;  ///< seen through
  double occluded = 0.0;      ///< something else in front
  double unknown = 0.0;       ///< not measured
  int samples = 0;            ///< of which these are shares

  /// Of what speaks for or against the model, the share that speaks for it; 0 if nothing does.
  double consent() const { return explained > 0.0 ? explained / (explained + contradicted) : 0.0; }
};

/// What the camera sees just beyond the model's outline, where something farther away, or nothing,
/// should be. Where the surface goes on, the model may be a patch of a wall.
struct OutlineAgreement {
  int samples = 0;  ///< at the outline, where something in front does not hide what is beyond
  int goes_on = 0;  ///< of these, where the scene continues the model's surface

  double continued() const { return samples > 0 ? static_cast<double>(goes_on) / samples : 0.0; }
};

/// Of each body at these poses, and over all of them. The surface may show a slightly different
/// configuration: its samples are carried along.
class AgreementMeter {
 public:
  void measure(const ArticulatedModel& model, const VisibleSurface& surface,
               const BodyPoses& T_camera_body, const TiledCloud& cloud,
               const RegistrationOptions& options, const Executor& executor);

  const Agreement& total() const { return total_; }
  const std::vector<Agreement>& bodies() const { return bodies_; }
  const OutlineAgreement& outline() const { return outline_; }

 private:
  /// What was measured where samples of a body are, camera's frame.
  struct MeasuredPoints {
    std::size_t size = 0;
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;
    std::vector<float> expected;            ///< depth of the sample
    std::vector<float> distance;            ///< of the point from the body
    std::vector<std::uint32_t> view_pixel;  ///< of the sample
  };

  void reserve(const Executor& executor, std::size_t bodies, std::size_t points);
  static void look_at_row(const ArticulatedModel& model, const VisibleSurface& surface,
                          const BodyPoses& T_camera_body, const TiledCloud& cloud,
                          const RegistrationOptions& options, const ReprojectedView& reprojected,
                          int v, std::span<MeasuredPoints> points, std::span<Agreement> counts,
                          OutlineAgreement& outline);
  static void count_points(const ArticulatedModel& model, const VisibleSurface& surface,
                           std::size_t body, const Eigen::Isometry3d& T_camera_body,
                           const TiledCloud& cloud, const RegistrationOptions& options,
                           MeasuredPoints& points, Agreement& counts);

  Agreement total_;
  std::vector<Agreement> bodies_;        ///< by body
  std::vector<Agreement> chunk_bodies_;  ///< by chunk of samples and body
  std::vector<OutlineAgreement> chunk_outlines_;
  OutlineAgreement outline_;
  ReprojectedView::Scratch scratch_;
  std::vector<MeasuredPoints> points_;  ///< by worker and body
};

}  // namespace lockbox

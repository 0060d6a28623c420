// SPDX-License-Identifier: BSD-3-Clause
// Compares the visible surface of a registered model with the image.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/function_ref.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/verification/agreement.hpp"
#include "lockbox/verification/contour_agreement.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/view_samples.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// Of each body at these poses, and over all of them. The surface may show a slightly different
/// configuration: its samples are carried along.
class ConsistencyCheck {
 public:
  /// meanwhile: called once, by one of the threads; what no other could share with it.
  void measure(const ArticulatedModel& model, const VisibleSurface& surface,
               const ViewSamples& samples, const BodyPoses& T_camera_body, const TiledCloud& cloud,
               const ViewOptions& options, const Executor& executor, FunctionRef<void()> meanwhile);

  const Agreement& total() const { return total_; }
  const std::vector<Agreement>& bodies() const { return bodies_; }
  const ContourAgreement& contour() const { return contour_; }

 private:
  /// What was measured where samples of a body are, camera's frame: memory of a worker.
  struct MeasuredPoints {
    std::size_t size = 0;
    std::vector<float> depth;
    std::vector<float> expected;        ///< depth of the sample
    std::vector<std::uint8_t> is_near;  ///< whether the point is within the body's gate
    std::vector<std::uint32_t> number;  ///< of the sample, in its chunk
    std::vector<std::int32_t> pixel;    ///< of the image

    /// Those of which the body's field has to tell.
    std::size_t unsure = 0;
    std::vector<std::uint32_t> index;  ///< among all
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;
    std::vector<float> distance;
  };
  struct Scene;

  void reserve(const Executor& executor);
  void look_at_chunk(const Scene& scene, std::size_t chunk);
  static void ask_field(const Scene& scene, int body, MeasuredPoints& points);
  static void count_points(const Scene& scene, const ViewSamples::Chunk& chunk,
                           const MeasuredPoints& points, Agreement& counts);

  Agreement total_;
  std::vector<Agreement> bodies_;  ///< by body
  ContourAgreement contour_;
  std::vector<Agreement> chunk_counts_;  ///< by chunk of samples
  std::vector<ContourSides> chunk_contours_;
  std::vector<ContourSides> body_contours_;  ///< by body
  SampleLandings landings_;
  std::vector<MeasuredPoints> points_;  ///< by worker
};

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
// What the pixels of one patch are expected to measure at the edges of the model, and how that
// changes with the motion of each body.
//
// Under lateral jitter a pixel measures the inverse depth d at a random point around its centre,
// with a density w. The mean is a smooth function of the bodies' poses even at edges: a blurred
// image changes where the surface's inverse depth does, and moves with its image; of two
// neighbouring samples the one that is nearer, which hides the other, moves the edge:
//
//   mean = sum_samples w d,    dmean = sum_samples w dd - sum_neighbours w (d_next - d) flow_nearer
//
// All points of a body within a pixel's reach have the ray of the pixel, so that six moments of a
// body's samples are enough for the derivative by its twist.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/kernels/edge_moments.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

class EdgePatch {
 public:
  static constexpr int kSamples = kernels::kSamplesPerPixel;  ///< along each side of a pixel
  static constexpr int kReach = kernels::kWindowTaps / 2;     ///< samples that a pixel looks aside
  static constexpr int kSide = kernels::kWindowPixels;        ///< of a patch, pixels
  /// A patch that shows more bodies is not read. Source: not recorded. Doubled, more patches are
  /// read where many small bodies meet, and each thread keeps twice the memory for them.
  static constexpr int kMostBodies = 6;

  /// lateral_pixels: standard deviation of the jitter.
  explicit EdgePatch(double lateral_pixels);

  /// Samples along each side of what a patch is read from, of which kReach lie before the centre of
  /// its first pixel.
  static constexpr int kWindow = static_cast<int>(kernels::kWindowSide);

  /// Reads the patch whose window begins at sample (left, top), and lies within a rendering with
  /// kSamples samples a pixel and axis, which must outlive what is asked of the patch. False if it
  /// shows too many bodies, or none.
  bool read(const RenderedInverseDepth& samples, int left, int top);

  /// Bodies that the patch shows.
  std::span<const std::int16_t> bodies() const { return {bodies_.data(), body_count_}; }

  /// The pixels of this row, bit by bit, whose inverse depth bends towards that of their neighbours
  /// by more than this (1/metre), or breaks; not if one of them shows nothing.
  std::uint32_t bending(int row, float least) const;
  /// Returns whether the patch's pixel in this column and row may show nothing of the model.
  bool may_show_nothing(int column, int row) const;

  /// What follows is about the pixels of this row from the first column to before the end, until
  /// the next call.
  void begin_row(int row, int first, int end);
  /// And of this pixel in it.
  void look_at(int column);

  /// Inverse depth that the pixel measures, 1/metre, and its variance.
  float mean() const { return mean_; }
  float variance() const { return variance_; }

  /// Returns the derivative of the mean by the twist of bodies()[body], in the camera's frame,
  /// 1/metre. x, y: the pixel's ray (x, y, 1).
  Eigen::Matrix<float, 6, 1> derivative(std::size_t body, float x, float y,
                                        const PinholeCamera& camera) const;

 private:
  /// Of one body: over its samples, and over the steps that it moves along rows (u) and columns.
  struct Moments {
    float d;
    float d_squared;
    float step_u;
    float step_u_d;
    float step_v;
    float step_v_d;
  };

  bool find_bodies();
  bool add_body(std::int16_t body);

  kernels::WindowTaps taps_;
  kernels::EdgeWindow window_{};
  std::array<std::int16_t, kMostBodies> bodies_{};
  std::size_t body_count_ = 0;
  bool shows_nothing_ = false;
  float reference_ = 0.0F;  ///< an inverse depth of the patch, lest squares cancel

  std::array<kernels::ColumnMoments, kMostBodies> columns_;  ///< of the row, by body
  alignas(64) kernels::ColumnMoments::Sums squares_;
  std::array<Moments, kMostBodies> moments_;  ///< of the pixel, by body
  float mean_ = 0.0F;
  float variance_ = 0.0F;
};

}  // namespace lockbox

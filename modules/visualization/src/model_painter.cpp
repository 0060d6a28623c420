// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/model_painter.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr int kSamplesAPixel = 2;  // along each axis; smooths the edges
constexpr float kAmbient = 0.35F;
constexpr float kContour = 0.45F;
/// A step in depth of this share of the distance is an edge that is worth a line.
constexpr float kContourStep = 0.002F;

/// Inverse depth at (u, v), 0 beyond the image.
float inverse_depth(const RenderedDepth& rendered, int u, int v) {
  if (u < 0 || v < 0 || u >= rendered.width || v >= rendered.height) return 0.0F;
  return 1.0F /
         rendered.depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(rendered.width) +
                        static_cast<std::size_t>(u)];
}

/// The smaller of the differences to both sides: the other one may cross an edge.
float gentle_difference(float before, float here, float after) {
  const float left = here - before;
  const float right = after - here;
  return std::abs(left) < std::abs(right) ? left : right;
}

/// A plane n . p = 1 has 1/z = n . ray, which is linear in the image: its slopes give the normal.
Eigen::Vector3f normal_at(const RenderedDepth& rendered, const PinholeCamera& camera, int u,
                          int v) {
  const float here = inverse_depth(rendered, u, v);
  const float du =
      gentle_difference(inverse_depth(rendered, u - 1, v), here, inverse_depth(rendered, u + 1, v));
  const float dv =
      gentle_difference(inverse_depth(rendered, u, v - 1), here, inverse_depth(rendered, u, v + 1));
  const float x = du * static_cast<float>(camera.fx);
  const float y = dv * static_cast<float>(camera.fy);
  const float u_centred = static_cast<float>(u - camera.cx);
  const float v_centred = static_cast<float>(v - camera.cy);
  return -Eigen::Vector3f(x, y, here - du * u_centred - dv * v_centred).normalized();
}

bool is_edge(const RenderedDepth& rendered, int u, int v) {
  const float here = inverse_depth(rendered, u, v);
  const float bend_u =
      inverse_depth(rendered, u - 1, v) + inverse_depth(rendered, u + 1, v) - 2.0F * here;
  const float bend_v =
      inverse_depth(rendered, u, v - 1) + inverse_depth(rendered, u, v + 1) - 2.0F * here;
  // Only the farther side of a step is darkened, so that lines are one sample wide.
  return std::max(bend_u, bend_v) > kContourStep * here;
}

bool is_grey(const Eigen::Vector3f& color) {
  constexpr float kLeastSaturation = 0.1F;  // that is seen over grey
  return color.maxCoeff() - color.minCoeff() < kLeastSaturation;
}

PinholeCamera supersampled(const PinholeCamera& camera) {
  constexpr double kShift = 0.5 * (kSamplesAPixel - 1);  // of a pixel's centre among its samples
  return {camera.width * kSamplesAPixel,       camera.height * kSamplesAPixel,
          camera.fx * kSamplesAPixel,          camera.fy * kSamplesAPixel,
          camera.cx * kSamplesAPixel + kShift, camera.cy * kSamplesAPixel + kShift};
}

}  // namespace

ModelPainter::ModelPainter(const KinematicTree& tree, const PinholeCamera& camera,
                           const Executor& executor, GreyModel grey)
    : tree_(tree), renderer_(supersampled(camera), executor) {
  for (std::size_t body = 0; body < tree.bodies.size(); ++body) {
    for (const auto& visual : tree.bodies[body].visuals) {
      items_.push_back(
          {&visual.mesh, Eigen::Isometry3d::Identity(), static_cast<std::int16_t>(items_.size())});
      body_of_item_.push_back(static_cast<int>(body));
      color_of_item_.push_back(visual.rgba.head<3>());
    }
  }
  if (grey == GreyModel::in_orange &&
      std::all_of(color_of_item_.begin(), color_of_item_.end(), is_grey)) {
    std::fill(color_of_item_.begin(), color_of_item_.end(), Eigen::Vector3f(1.0F, 0.6F, 0.2F));
  }
}

std::vector<std::optional<Eigen::Vector3f>> ModelPainter::body_colors() const {
  std::vector<std::optional<Eigen::Vector3f>> colors(tree_.bodies.size());
  for (std::size_t i = items_.size(); i-- > 0;) {
    colors[static_cast<std::size_t>(body_of_item_[i])] = color_of_item_[i];
  }
  return colors;
}

void ModelPainter::place_items(const Configuration& configuration) {
  forward_kinematics(tree_, configuration, T_camera_body_);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    items_[i].T_camera_mesh = T_camera_body_[static_cast<std::size_t>(body_of_item_[i])];
  }
}

Eigen::Vector3f ModelPainter::color_of_sample(int u, int v) const {
  const Eigen::Vector3f to_light = Eigen::Vector3f(-0.35F, -0.55F, -1.0F).normalized();
  const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(rendered_.width) +
                        static_cast<std::size_t>(u);
  const Eigen::Vector3f& color = color_of_item_[static_cast<std::size_t>(rendered_.id[i])];
  const Eigen::Vector3f normal = normal_at(rendered_, renderer_.camera(), u, v);
  float light = kAmbient + (1.0F - kAmbient) * std::max(0.0F, normal.dot(to_light));
  if (is_edge(rendered_, u, v)) light *= kContour;
  return color * light;
}

void ModelPainter::paint(const Configuration& configuration, float opacity, RgbImage& image) {
  place_items(configuration);
  renderer_.render(items_, rendered_);
  const float weight = opacity / static_cast<float>(kSamplesAPixel * kSamplesAPixel);
  std::vector<Eigen::Vector3f> sums(image.rgb.size() / 3, Eigen::Vector3f::Zero());
  std::vector<float> cover(image.rgb.size() / 3, 0.0F);
  for (int v = 0; v < rendered_.height; ++v) {
    for (int u = 0; u < rendered_.width; ++u) {
      const std::size_t sample =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(rendered_.width) +
          static_cast<std::size_t>(u);
      if (rendered_.id[sample] == kNothing) continue;
      const std::size_t pixel =
          static_cast<std::size_t>(v / kSamplesAPixel) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(u / kSamplesAPixel);
      sums[pixel] += weight * color_of_sample(u, v);
      cover[pixel] += weight;
    }
  }
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const float behind = (1.0F - cover[i / 3]) * static_cast<float>(image.rgb[i]);
    const float front = 255.0F * sums[i / 3](static_cast<Eigen::Index>(i % 3));
    image.rgb[i] = static_cast<std::uint8_t>(std::clamp(behind + front, 0.0F, 255.0F));
  }
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "height_template.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "lockbox/core/function_ref.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "model_sides.hpp"

namespace lockbox {
namespace {

constexpr double kCells = 36.0;       // across the diameter of the model at rest
constexpr int kSubsamples = 3;        // along each side of a cell
constexpr int kJointDraws = 40;       // to see what joints may change
constexpr int kFewDraws = 4;          // to see whether a side is seen at all
constexpr double kDistance = 200.0;   // metres: so far away a pinhole sees parallel rays
constexpr float kFlat = 0.004F;       // metres: heights that are one height
constexpr float kHeightStep = 0.02F;  // metres: so exactly ranges of heights are told apart
constexpr int kRing = 2;              // cells around the model where nothing is expected

constexpr float kNone = -std::numeric_limits<float>::infinity();

/// All configurations in which a body may be surrounded by the others, that body at the origin.
std::vector<std::vector<Eigen::Isometry3d>> joint_draws(const KinematicTree& tree, int body,
                                                        int draws_of_moving) {
  std::mt19937_64 engine(1);
  std::vector<std::vector<Eigen::Isometry3d>> draws;
  Configuration configuration = rest_configuration(tree);
  for (int draw = 0; draw < (tree.variables() > 0 ? draws_of_moving : 1); ++draw) {
    for (int v = 0; v < tree.variables() && draw > 0; ++v) {
      const VariableRange range = variable_range(tree, v);
      const double share = static_cast<double>(engine() >> 11U) * 0x1.0p-53;
      configuration.q[v] = range.lower + share * range.extent();
    }
    auto& poses = draws.emplace_back();
    forward_kinematics(tree, configuration, poses);
    const Eigen::Isometry3d inverse = poses[static_cast<std::size_t>(body)].inverse();
    for (auto& pose : poses) pose = inverse * pose;
  }
  return draws;
}

/// Lowest and highest surface of each cell over all draws and subsamples.
struct HeightRanges {
  int size;  ///< cells along each side
  std::vector<float> low;
  std::vector<float> high;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
           static_cast<std::size_t>(x);
  }
  bool is_flat(std::size_t cell) const {
    return low[cell] > kNone && high[cell] - low[cell] < kFlat;
  }
};

HeightRanges measure(const KinematicTree& tree, const Eigen::Isometry3d& T_body_plane,
                     const std::vector<std::vector<Eigen::Isometry3d>>& draws, double cell_size,
                     int size, const Executor& executor) {
  const int pixels = size * kSubsamples;
  const double focal = kDistance * kSubsamples / cell_size;
  const double centre = 0.5 * (pixels - 1);
  DepthRenderer renderer({pixels, pixels, focal, focal, centre, centre}, executor);
  Eigen::Isometry3d T_camera_plane = Eigen::Isometry3d::Identity();
  T_camera_plane.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_camera_plane.translation().z() = kDistance;
  const Eigen::Isometry3d T_camera_body = T_camera_plane * T_body_plane.inverse();

  const auto cells = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  HeightRanges ranges{size, std::vector<float>(cells, -kNone), std::vector<float>(cells, kNone)};
  std::vector<RenderItem> items;
  RenderedDepth image;
  for (const auto& poses : draws) {
    items.clear();
    for (std::size_t b = 0; b < poses.size(); ++b) {
      items.push_back(body_item(tree, b, T_camera_body * poses[b]));
    }
    renderer.render(items, image);
    for (int v = 0; v < pixels; ++v) {
      for (int u = 0; u < pixels; ++u) {
        const float depth = image.depth[static_cast<std::size_t>(v * pixels + u)];
        const float height = static_cast<float>(kDistance) - depth;  // -inf where nothing is
        const std::size_t cell = ranges.index(u / kSubsamples, size - 1 - v / kSubsamples);
        ranges.low[cell] = std::min(ranges.low[cell], height);
        ranges.high[cell] = std::max(ranges.high[cell], height);
      }
    }
  }
  return ranges;
}

float quantized(float height) {
  return kHeightStep * std::round(height / kHeightStep);
}

/// Height of the nearest flat cell within the ring, if there is one.
float edge_height(const HeightRanges& ranges, int x, int y) {
  for (int radius = 1; radius <= kRing; ++radius) {
    for (int j = std::max(0, y - radius); j <= std::min(ranges.size - 1, y + radius); ++j) {
      for (int i = std::max(0, x - radius); i <= std::min(ranges.size - 1, x + radius); ++i) {
        const std::size_t cell = ranges.index(i, j);
        if (ranges.is_flat(cell)) return 0.5F * (ranges.low[cell] + ranges.high[cell]);
      }
    }
  }
  return kNone;
}

int expectation_index(HeightTemplate& height_template, const Expectation& expectation) {
  auto& all = height_template.expectations;
  const auto found = std::find(all.begin(), all.end(), expectation);
  if (found != all.end()) return static_cast<int>(found - all.begin());
  all.push_back(expectation);
  return static_cast<int>(all.size()) - 1;
}

void fill_cells(const HeightRanges& ranges, HeightTemplate& height_template) {
  const double middle = 0.5 * (ranges.size - 1);
  for (int y = 0; y < ranges.size; ++y) {
    for (int x = 0; x < ranges.size; ++x) {
      const std::size_t cell = ranges.index(x, y);
      Expectation expectation{ranges.low[cell], ranges.high[cell], false};
      if (ranges.is_flat(cell)) {
        const float mean = 0.5F * (expectation.low + expectation.high);
        expectation.low = expectation.high = kFlat * std::round(mean / kFlat);
      } else if (expectation.high == kNone) {
        expectation.low = expectation.high = edge_height(ranges, x, y);
        expectation.nothing = true;
        if (expectation.low == kNone) continue;
      } else if (expectation.low == kNone) {
        continue;  // there may be anything
      } else {
        expectation.low = quantized(expectation.low);
        expectation.high = quantized(expectation.high);
      }
      height_template.cells.push_back({static_cast<float>((x - middle) * height_template.cell_size),
                                       static_cast<float>((y - middle) * height_template.cell_size),
                                       expectation_index(height_template, expectation)});
      height_template.radius = std::max(
          height_template.radius, std::hypot(x - middle, y - middle) * height_template.cell_size);
    }
  }
}

Eigen::AlignedBox3d rest_bounds(const KinematicTree& tree, int body) {
  Eigen::AlignedBox3d box;
  const auto draws = joint_draws(tree, body, 1);
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    for (const auto& vertex : tree.bodies[b].mesh.vertices) box.extend(draws[0][b] * vertex);
  }
  return box;
}

/// Lowest point of the body over the plane through the origin.
double support(const TriangleMesh& mesh, const Eigen::Vector3d& normal) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& vertex : mesh.vertices) lowest = std::min(lowest, normal.dot(vertex));
  return lowest;
}

/// Area of the cells in which the plane itself may be seen.
double visible_area(const HeightTemplate& height_template) {
  const auto in_plane = std::count_if(
      height_template.cells.begin(), height_template.cells.end(), [&](const TemplateCell& cell) {
        const Expectation& expected =
            height_template.expectations[static_cast<std::size_t>(cell.expectation)];
        return !expected.nothing && expected.low < kFlat && expected.high > -kFlat;
      });
  return static_cast<double>(in_plane) * height_template.cell_size * height_template.cell_size;
}

HeightTemplate make_height_template(const KinematicTree& tree, int body, const Eigen::Vector3d& z,
                                    double offset, int draws, double cell_size,
                                    const Executor& executor) {
  const Eigen::AlignedBox3d box = rest_bounds(tree, body);
  HeightTemplate height_template;
  height_template.body = body;
  height_template.cell_size = cell_size;
  const Eigen::Vector3d x = z.unitOrthogonal();
  height_template.T_body_plane = Eigen::Isometry3d::Identity();
  height_template.T_body_plane.linear() << x, z.cross(x), z;
  height_template.T_body_plane.translation() = box.center() + (offset - z.dot(box.center())) * z;
  fill_cells(measure(tree, height_template.T_body_plane, joint_draws(tree, body, draws),
                     height_template.cell_size, static_cast<int>(kCells) + 2 * kRing + 1, executor),
             height_template);
  height_template.area = visible_area(height_template);
  return height_template;
}

/// Makes templates of the model's large sides, the largest first.
std::vector<HeightTemplate> templates_of_sides(
    const KinematicTree& tree,
    FunctionRef<HeightTemplate(int body, const Eigen::Vector3d& normal, double offset, int draws)>
        template_of) {
  std::vector<ModelSide> sides = flat_sides(tree);
  std::vector<HeightTemplate> templates;
  // What lies inside is never seen: for most sides a glance tells.
  for (const int draws : {kFewDraws, kJointDraws}) {
    std::vector<HeightTemplate> all;
    std::vector<Facing> facings;
    all.reserve(sides.size());
    facings.reserve(sides.size());
    for (const auto& [body, flat, normal] : sides) {
      all.push_back(template_of(body, flat.normal, flat.offset, draws));
      facings.push_back({normal, all.back().area});
    }
    std::vector<ModelSide> large;
    templates.clear();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (facings[i].area == 0.0 || !is_large(facings[i], facings)) continue;
      large.push_back(sides[i]);
      templates.push_back(std::move(all[i]));
    }
    sides = std::move(large);
  }
  std::stable_sort(
      templates.begin(), templates.end(),
      [](const HeightTemplate& a, const HeightTemplate& b) { return a.area > b.area; });
  return templates;
}

bool same_view(const HeightTemplate& a, const HeightTemplate& b) {
  const Eigen::Isometry3d difference = a.T_body_plane.inverse() * b.T_body_plane;
  // Seen along directions within 2.6 degrees, and sides within 1 cm, they show the same.
  return a.body == b.body && difference.linear().col(2).z() > 0.999 &&
         std::abs(difference.translation().z()) < 0.01;
}

}  // namespace

std::vector<HeightTemplate> make_height_templates(const KinematicTree& tree,
                                                  const Executor& executor,
                                                  const StopRequest& stop_request) {
  const double cell_size = rest_bounds(tree, 0).diagonal().norm() / kCells;
  const auto template_of = [&](int body, const Eigen::Vector3d& z, double offset, int draws) {
    stop_if(stop_request);
    return make_height_template(tree, body, z, offset, draws, cell_size, executor);
  };
  std::vector<HeightTemplate> sides = templates_of_sides(tree, template_of);
  std::vector<HeightTemplate> templates;
  const auto add = [&](HeightTemplate height_template) {
    const bool known =
        std::any_of(templates.begin(), templates.end(),
                    [&](const HeightTemplate& other) { return same_view(height_template, other); });
    if (!known) templates.push_back(std::move(height_template));
  };
  for (HeightTemplate& side : sides) add(std::move(side));
  if (templates.empty()) {  // a rounded model still stands on something
    for (int axis = 0; axis < 6; ++axis) {
      const Eigen::Vector3d z = (axis < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(axis % 3);
      add(template_of(0, z, support(tree.bodies[0].mesh, z), kJointDraws));
    }
    return templates;
  }
  // What the base may stand on or touch with its back.
  const std::vector<HeightTemplate> visible = templates;
  for (const HeightTemplate& side : visible) {
    if (side.body != 0) continue;
    const Eigen::Vector3d z = side.T_body_plane.linear().col(2);
    add(template_of(0, z, support(tree.bodies[0].mesh, z), kJointDraws));
  }
  return templates;
}

}  // namespace lockbox

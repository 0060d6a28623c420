// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/estimate_caption.hpp"

#include <iomanip>
#include <sstream>

#include "lockbox/visualization/joint_panel.hpp"

namespace lockbox {
namespace {

std::string base_line(const KinematicTree& tree, const Configuration& configuration) {
  const Eigen::Vector3d p_camera = configuration.T_camera_base.translation();
  std::ostringstream text;
  text << tree.bodies.front().name << " at " << std::fixed << std::setprecision(3) << p_camera.x()
       << ' ' << p_camera.y() << ' ' << p_camera.z() << " m";
  return text.str();
}

}  // namespace

std::vector<CaptionLine> estimate_caption(
    const KinematicTree& tree, const ShownEstimate& estimate, const std::string& title,
    const std::vector<std::optional<Eigen::Vector3f>>& colors) {
  std::vector<CaptionLine> lines = {{title, std::nullopt}, {estimate.belief, std::nullopt}};
  const Configuration& configuration = estimate.configuration;
  if (!configuration.T_camera_base.matrix().allFinite() || !configuration.q.allFinite()) {
    return lines;
  }
  lines.push_back({base_line(tree, configuration), colors.front()});
  for (const JointLine& line : joint_lines(tree, configuration, estimate.sigma)) {
    lines.push_back({line.text, line.joint ? colors[*line.joint + 1] : std::nullopt});
  }
  return lines;
}

}  // namespace lockbox

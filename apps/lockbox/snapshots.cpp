// SPDX-License-Identifier: BSD-3-Clause
#include "snapshots.hpp"
#include "command_line/output_paths.hpp"

#include <iomanip>
#include <sstream>

#include "lockbox/visualization/depth_picture.hpp"
#include "lockbox/visualization/estimate_caption.hpp"

namespace lockbox::app {
namespace {

constexpr float kOpacity = 0.65F;

/// Returns the room of a caption in which everything is known.
CaptionRoom largest_room(const KinematicTree& tree) {
  ShownEstimate known(rest_configuration(tree), std::vector<double>(tree.joints.size(), 1.0));
  known.belief = belief_line(1.0, "");
  return room_for(
      estimate_caption(tree, known, "", {tree.bodies.size(), std::optional<Eigen::Vector3f>()}));
}

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& folder, const KinematicTree& tree,
                     std::size_t interval, const Executor& executor)
    : folder_(folder),
      tree_(tree),
      interval_(interval),
      executor_(executor),
      room_(largest_room(tree)) {
  make_folder(folder);
}

void Snapshots::add(const DepthFrame& frame, const ShownEstimate& estimate,
                    const std::string& title) {
  if (count_++ % interval_ != 0) return;
  RgbImage picture = depth_picture(frame);
  if (!painter_ || !(frame.camera == camera_)) {
    painter_.emplace(tree_, frame.camera, executor_, GreyModel::in_orange);
  }
  camera_ = frame.camera;
  if (estimate.configuration.T_camera_base.matrix().allFinite()) {
    painter_->paint(estimate.configuration, kOpacity, picture);
  }
  const auto caption = estimate_caption(tree_, estimate, title, painter_->body_colors());
  write_png(folder_ / name_of(count_ - 1), with_caption(picture, caption, room_));
}

std::string Snapshots::name_of(std::size_t frame) {
  std::ostringstream name;
  name << "frame_" << std::setw(6) << std::setfill('0') << frame << ".png";
  return name.str();
}

}  // namespace lockbox::app

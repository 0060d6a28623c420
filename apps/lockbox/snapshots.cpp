// SPDX-License-Identifier: BSD-3-Clause
#include "snapshots.hpp"
#include "command_line/output_paths.hpp"

#include <iomanip>
#include <sstream>

#include "lockbox/visualization/depth_picture.hpp"

namespace lockbox::app {
namespace {

constexpr float kOpacity = 0.65F;

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& folder, const KinematicTree& tree,
                     std::size_t interval, const Executor& executor)
    : folder_(folder), tree_(tree), interval_(interval), executor_(executor) {
  make_folder(folder);
}

void Snapshots::add(const DepthFrame& frame, const Configuration& configuration) {
  if (count_++ % interval_ != 0) return;
  RgbImage picture = depth_picture(frame);
  if (configuration.T_camera_base.matrix().allFinite()) {
    if (!painter_ || !(frame.camera == camera_)) {
      painter_.emplace(tree_, frame.camera, executor_, GreyModel::in_orange);
    }
    camera_ = frame.camera;
    painter_->paint(configuration, kOpacity, picture);
  }
  write_png(folder_ / name_of(count_ - 1), picture);
}

std::string Snapshots::name_of(std::size_t frame) {
  std::ostringstream name;
  name << "frame_" << std::setw(6) << std::setfill('0') << frame << ".png";
  return name.str();
}

}  // namespace lockbox::app

// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdio>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "png16.hpp"

namespace lockbox {
namespace {

/// Units per metre of a frame: the unit is stored as a float, the scale is a round number.
double scale_of(const DepthFrame& frame) {
  const double scale = 1.0 / double{frame.metres_per_unit};
  const double rounded = std::round(scale);
  return std::abs(scale - rounded) < 1e-6 * scale ? rounded : scale;
}

}  // namespace

DepthFolderWriter::DepthFolderWriter(const std::filesystem::path& folder) : folder_(folder) {
  if (std::filesystem::exists(folder / "depth.txt")) {
    throw InputError(folder.string(),
                     "holds a depth sequence already; remove it or choose another folder");
  }
  std::error_code error;
  std::filesystem::create_directories(folder / "depth", error);
  index_.open(folder / "depth.txt");
  index_ << "# timestamp filename" << std::endl;
  if (error || !index_) {
    throw InputError(folder.string(), "a depth sequence cannot be written there" +
                                          (error ? " (" + error.message() + ")" : std::string()));
  }
}

void DepthFolderWriter::begin(const DepthFrame& first) {
  write_camera_info(folder_ / "camera_info.yaml",
                    {.camera = first.camera, .distortion = {}, .depth_scale = scale_of(first)});
  first_.camera = first.camera;
  first_.metres_per_unit = first.metres_per_unit;
}

void DepthFolderWriter::write(const DepthFrame& frame) {
  if (count_ == 0) {
    begin(frame);
  }
  if (!(frame.camera == first_.camera) || frame.metres_per_unit != first_.metres_per_unit) {
    throw InputError(folder_.string(), "frame " + std::to_string(count_) +
                                           " has another camera or depth unit than the first; a "
                                           "depth sequence has one of each");
  }
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "depth/%06zu.png", count_);
  write_png16(folder_ / name.data(), frame.camera.width, frame.camera.height, frame.depth);
  index_ << fixed_number_text(frame.stamp) << ' ' << name.data() << std::endl;
  if (!index_) {
    throw InputError((folder_ / "depth.txt").string(), "cannot be written; is the disk full?");
  }
  ++count_;
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "depth_index.hpp"
#include "depth_plausibility.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "png16.hpp"
#include "rectification.hpp"
#include "spoiled_frames.hpp"

namespace lockbox {
namespace {

constexpr double kUsualUnits = 1000.0;  // units per metre where nothing else is said

CameraCalibration calibration_of(const std::filesystem::path& folder,
                                 const SourceOptions& options) {
  if (std::optional<CameraCalibration> given = given_calibration(options)) {
    return *given;
  }
  const std::filesystem::path beside = folder / "camera_info.yaml";
  if (!is_there(beside)) {
    throw InputError(
        folder.string(),
        "the camera is unknown: put a camera_info.yaml (ROS camera calibration) beside "
        "depth.txt, or give one with --camera-info");
  }
  return read_calibration(beside, options);
}

}  // namespace

struct DepthFolderSource::Impl {
  Impl(const std::filesystem::path& path, const SourceOptions& options)
      : folder(path),
        warn(options.warn ? options.warn : [](const std::string&) {}),
        entries(read_depth_index(path / "depth.txt", warn)),
        calibration(calibration_of(path, options)),
        given_scale(options.depth_scale ? options.depth_scale : calibration.depth_scale),
        units_per_metre(given_scale.value_or(kUsualUnits)),
        rectification(calibration),
        spoiled(path.string(), warn) {
    if (!(units_per_metre > 0.0) || !std::isfinite(units_per_metre)) {
      throw InputError(path.string(), "the depth scale must be positive: units per metre");
    }
    first_usable_frame(folder.string(), entries.size(),
                       [this](std::size_t frame) { return load(frame); });
  }

  /// Returns what prevents the use of the image.
  std::optional<std::string> load(std::size_t frame) try {
    const std::string name = entries[frame].image.string();
    read_png16(name, image);
    rectification.check_size(image.width, image.height, name);
    return std::nullopt;
  } catch (const InputError& error) {
    return std::string(error.what()) + " (line " + std::to_string(entries[frame].line) +
           " of depth.txt)";
  }

  void take_image(DepthFrame& frame) {
    if (const std::optional<std::string> problem = load(position)) {
      spoiled.add(*problem);
      frame.depth.assign(static_cast<std::size_t>(calibration.camera.width) *
                             static_cast<std::size_t>(calibration.camera.height),
                         0);
    } else {
      frame.depth.swap(image.pixels);
    }
  }

  /// Asked of frames until one is in doubt, or thirty have passed.
  void check_scale(const DepthFrame& frame) {
    constexpr std::size_t kChecked = 30;
    if (scale_is_told || frame.index >= kChecked) {
      return;
    }
    if (const auto doubt = doubtful_depth_scale(frame, units_per_metre, given_scale.has_value())) {
      warn(entries[frame.index].image.string() + ": " + *doubt);
      scale_is_told = true;
    }
  }

  std::filesystem::path folder;
  std::function<void(const std::string&)> warn;
  std::vector<DepthIndexEntry> entries;
  CameraCalibration calibration;
  std::optional<double> given_scale;
  double units_per_metre;
  Rectification rectification;
  SpoiledFrames spoiled;
  Image16 image;
  std::size_t position = 0;
  bool scale_is_told = false;
};

DepthFolderSource::DepthFolderSource(const std::filesystem::path& folder,
                                     const SourceOptions& options)
    : impl_(std::make_unique<Impl>(folder, options)) {}

DepthFolderSource::~DepthFolderSource() = default;

bool DepthFolderSource::next(DepthFrame& frame) {
  if (impl_->position == impl_->entries.size()) {
    impl_->spoiled.finish(impl_->entries.size());
    return false;
  }
  impl_->take_image(frame);
  frame.metres_per_unit = static_cast<float>(1.0 / impl_->units_per_metre);
  frame.stamp = impl_->entries[impl_->position].stamp;
  frame.index = impl_->position++;
  impl_->rectification.apply(frame);
  impl_->check_scale(frame);
  return true;
}

std::optional<std::size_t> DepthFolderSource::frame_count() const {
  return impl_->entries.size();
}

SourceFaults DepthFolderSource::faults() const {
  return {.unreadable = impl_->spoiled.count()};
}

bool DepthFolderSource::is_unit_stated() const {
  return impl_->given_scale.has_value();
}

std::string DepthFolderSource::file_of_frame() const {
  return impl_->position == 0 ? std::string() : impl_->entries[impl_->position - 1].image.string();
}

std::string DepthFolderSource::description() const {
  return "depth images in " + impl_->folder.string() + ", " +
         fixed_number_text(impl_->units_per_metre) +
         (impl_->units_per_metre == 1.0 ? " unit per metre" : " units per metre");
}

}  // namespace lockbox

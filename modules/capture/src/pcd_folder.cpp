// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/pcd_folder.hpp"

#include <cmath>

#include "cloud_camera.hpp"
#include "depth_plausibility.hpp"
#include "lockbox/core/error.hpp"
#include "pcd_files.hpp"
#include "pcd_reader.hpp"
#include "rectification.hpp"
#include "spoiled_frames.hpp"

namespace lockbox {

struct PcdFolderSource::Impl {
  Impl(const std::filesystem::path& path, const SourceOptions& options)
      : folder(path),
        warn(options.warn ? options.warn : [](const std::string&) {}),
        clouds(timed_clouds(path, warn)),
        is_unit_given(options.depth_scale.has_value()),
        units_per_metre(options.depth_scale.value_or(1.0)),
        spoiled(path.string(), warn) {
    if (clouds.files.empty()) {
      throw InputError(path.string(), "this folder holds no .pcd files");
    }
    if (!(units_per_metre > 0.0) || !std::isfinite(units_per_metre)) {
      throw InputError(path.string(), "the depth scale must be positive: units per metre");
    }
    std::optional<CameraCalibration> calibration = given_calibration(options);
    if (calibration) {
      camera = calibration->camera;
    }
    rectification.emplace(std::move(calibration));
    const std::size_t first = first_usable_frame(
        folder.string(), clouds.files.size(), [this](std::size_t frame) { return look_at(frame); });
    check_scale(clouds.files[first].string());
  }

  /// Loads the cloud, and recovers the camera if that is not known yet. Returns what prevents the
  /// use of the cloud. Throws InputError if the cloud's points are on the rays of no camera.
  std::optional<std::string> look_at(std::size_t frame) {
    const std::string name = clouds.files[frame].string();
    if (std::optional<std::string> problem = load(frame)) {
      return problem;
    }
    if (camera.width == 0) {
      const std::optional<PinholeCamera> recovered = recover_camera(cloud, name);
      if (!recovered) {
        return name +
               ": has too few points to recover the camera from; give its calibration with "
               "--camera-info";
      }
      camera = *recovered;
    }
    return std::nullopt;
  }

  std::optional<std::string> load(std::size_t frame) try {
    const std::string name = clouds.files[frame].string();
    load_pcd(name, cloud);
    rectification->check_size(cloud.width, cloud.height, name);
    if (camera.width != 0 && (cloud.width != camera.width || cloud.height != camera.height)) {
      throw InputError(name, "has another size than the first cloud of the folder");
    }
    for (float& coordinate : cloud.xyz) {
      coordinate = static_cast<float>(coordinate / units_per_metre);
    }
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }

  void check_scale(const std::string& name) const {
    const auto doubt = doubtful_cloud_scale(cloud, units_per_metre);
    if (doubt && doubt->is_out_of_reach) {
      throw InputError(name, doubt->text);
    }
    if (doubt) {
      warn(name + ": " + doubt->text);
    }
  }

  void take_cloud(DepthFrame& frame) {
    if (const std::optional<std::string> problem = load(position)) {
      spoiled.add(*problem);
      frame.depth.assign(
          static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height), 0);
    } else {
      set_depth(cloud, frame);
    }
  }

  std::filesystem::path folder;
  std::function<void(const std::string&)> warn;
  TimedClouds clouds;
  bool is_unit_given;
  double units_per_metre;
  SpoiledFrames spoiled;
  PinholeCamera camera;  ///< given, or recovered
  std::optional<Rectification> rectification;
  OrganizedCloud cloud;
  std::size_t position = 0;
};

PcdFolderSource::PcdFolderSource(const std::filesystem::path& folder, const SourceOptions& options)
    : impl_(std::make_unique<Impl>(folder, options)) {}

PcdFolderSource::~PcdFolderSource() = default;

bool PcdFolderSource::next(DepthFrame& frame) {
  if (impl_->position == impl_->clouds.files.size()) {
    impl_->spoiled.finish(impl_->clouds.files.size());
    return false;
  }
  impl_->take_cloud(frame);
  frame.camera = impl_->camera;
  frame.stamp = impl_->clouds.stamps[impl_->position];
  frame.index = impl_->position++;
  impl_->rectification->apply(frame);
  return true;
}

std::optional<std::size_t> PcdFolderSource::frame_count() const {
  return impl_->clouds.files.size();
}

SourceFaults PcdFolderSource::faults() const {
  return {.unreadable = impl_->spoiled.count()};
}

bool PcdFolderSource::is_unit_stated() const {
  return impl_->is_unit_given;
}

std::string PcdFolderSource::file_of_frame() const {
  return impl_->position == 0 ? std::string() : impl_->clouds.files[impl_->position - 1].string();
}

std::string PcdFolderSource::description() const {
  return "organized clouds in " + impl_->folder.string();
}

}  // namespace lockbox

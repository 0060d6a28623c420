// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/pcd_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "cloud_camera.hpp"
#include "lockbox/core/error.hpp"
#include "pcd_component.hpp"
#include "rectification.hpp"
#include "stamp_in_name.hpp"

namespace lockbox {
namespace {

constexpr double kPeriod = 1.0 / 30.0;  // seconds, where names hold no stamps

std::vector<std::filesystem::path> clouds_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".pcd") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Stamps from the names if all hold one and they increase, else evenly spaced ones.
std::vector<double> stamps_of(const std::vector<std::filesystem::path>& files) {
  std::vector<double> stamps;
  for (const std::filesystem::path& file : files) {
    const std::optional<double> stamp = stamp_in_name(file.stem().string());
    if (!stamp || (!stamps.empty() && *stamp <= stamps.back())) {
      break;
    }
    stamps.push_back(*stamp);
  }
  if (stamps.size() != files.size()) {
    stamps.clear();
    for (std::size_t i = 0; i < files.size(); ++i) {
      stamps.push_back(kPeriod * static_cast<double>(i));
    }
  }
  return stamps;
}

}  // namespace

struct PcdFolderSource::Impl {
  Impl(const std::filesystem::path& path, const SourceOptions& options)
      : folder(path), files(clouds_in(path)), stamps(stamps_of(files)) {
    if (files.empty()) {
      throw InputError(path.string(), "this folder holds no .pcd files");
    }
    std::optional<CameraCalibration> calibration = given_calibration(options);
    if (!calibration) {
      load_pcd(files.front(), cloud);
      camera = recover_camera(cloud, files.front().string());
    }
    rectification.emplace(std::move(calibration));
  }

  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  std::vector<double> stamps;
  PinholeCamera camera;  ///< recovered, unless given
  std::optional<Rectification> rectification;
  OrganizedCloud cloud;
  std::size_t position = 0;
};

PcdFolderSource::PcdFolderSource(const std::filesystem::path& folder, const SourceOptions& options)
    : impl_(std::make_unique<Impl>(folder, options)) {}

PcdFolderSource::~PcdFolderSource() = default;

bool PcdFolderSource::next(DepthFrame& frame) {
  if (impl_->position == impl_->files.size()) {
    return false;
  }
  const std::filesystem::path& file = impl_->files[impl_->position];
  const OrganizedCloud& cloud = impl_->cloud;
  load_pcd(file, impl_->cloud);
  impl_->rectification->check_size(cloud.width, cloud.height, file.string());
  const bool is_given = impl_->camera.width == 0;
  if (!is_given && (cloud.width != impl_->camera.width || cloud.height != impl_->camera.height)) {
    throw InputError(file.string(), "has another size than the first cloud of the folder");
  }
  set_depth(cloud, frame);
  frame.camera = impl_->camera;
  frame.stamp = impl_->stamps[impl_->position];
  frame.index = impl_->position++;
  impl_->rectification->apply(frame);
  return true;
}

std::optional<std::size_t> PcdFolderSource::frame_count() const {
  return impl_->files.size();
}

std::string PcdFolderSource::description() const {
  return "organized clouds in " + impl_->folder.string();
}

PcdFolderWriter::PcdFolderWriter(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string(), "cannot be created (" + error.message() + ")");
  }
  if (!clouds_in(folder).empty()) {
    throw InputError(folder.string(),
                     "holds .pcd files already; remove them or choose another folder");
  }
}

void PcdFolderWriter::write(const DepthFrame& frame) const {
  if (!(frame.stamp >= 0.0)) {
    throw InputError(folder_.string(), "the stamps of frames must not be negative");
  }
  std::array<char, 64> name;  // zeros in front, so that name order is time order
  std::snprintf(name.data(), name.size(), "%018.6f.pcd", frame.stamp);
  save_pcd(folder_ / name.data(), cloud_of(frame));
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string_view>

#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "png16.hpp"
#include "rectification.hpp"

namespace lockbox {
namespace {

constexpr double kUsualUnits = 1000.0;  // units per metre where nothing else is said
constexpr double kPlausibleNear = 0.1;  // metres: medians outside are scale mistakes
constexpr double kPlausibleFar = 20.0;

struct Entry {
  double stamp;
  std::filesystem::path image;
};

Entry parse_entry(std::string_view text, const std::filesystem::path& index, int line) {
  const std::size_t space = text.find_first_of(" \t");
  const std::size_t name = text.find_first_not_of(" \t", space);
  const std::optional<double> stamp = parse_finite_number(text.substr(0, space));
  if (!stamp || name == std::string_view::npos) {
    throw InputError(index.string(), line, "expected \"timestamp filename\"");
  }
  const std::filesystem::path image = index.parent_path() / text.substr(name);
  if (!std::filesystem::is_regular_file(image)) {
    throw InputError(index.string(), line, "there is no image " + image.string());
  }
  return {*stamp, image};
}

std::vector<Entry> read_index(const std::filesystem::path& index) {
  std::ifstream in(index);
  if (!in) {
    throw InputError(index.string(), "no such file, or it cannot be read");
  }
  std::vector<Entry> entries;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos || text[first] == '#') {
      continue;
    }
    const std::size_t last = text.find_last_not_of(" \t\r");
    entries.push_back(
        parse_entry(std::string_view(text).substr(first, last - first + 1), index, line));
    if (entries.size() > 1 && entries.back().stamp <= entries[entries.size() - 2].stamp) {
      throw InputError(index.string(), line, "timestamps do not increase");
    }
  }
  if (entries.empty()) {
    throw InputError(index.string(), "lists no images");
  }
  return entries;
}

CameraCalibration calibration_of(const std::filesystem::path& folder,
                                 const SourceOptions& options) {
  if (std::optional<CameraCalibration> given = given_calibration(options)) {
    return *given;
  }
  const std::filesystem::path beside = folder / "camera_info.yaml";
  if (!std::filesystem::exists(beside)) {
    throw InputError(
        folder.string(),
        "the camera is unknown: put a camera_info.yaml (ROS camera calibration) beside "
        "depth.txt, or give one with --camera-info");
  }
  return read_camera_info(beside);
}

/// Median of the measured depths, in metres; nothing if there are none.
std::optional<double> median_depth(const DepthFrame& frame) {
  std::vector<std::uint16_t> measured;
  std::copy_if(frame.depth.begin(), frame.depth.end(), std::back_inserter(measured),
               [](std::uint16_t value) { return value != 0; });
  if (measured.empty()) {
    return std::nullopt;
  }
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end());
  return double{frame.metres_per_unit} * *middle;
}

}  // namespace

struct DepthFolderSource::Impl {
  Impl(const std::filesystem::path& path, const SourceOptions& options)
      : folder(path),
        entries(read_index(path / "depth.txt")),
        calibration(calibration_of(path, options)),
        units_per_metre(
            options.depth_scale.value_or(calibration.depth_scale.value_or(kUsualUnits))),
        rectification(calibration),
        warn(options.warn) {
    if (!(units_per_metre > 0.0) || !std::isfinite(units_per_metre)) {
      throw InputError(path.string(), "the depth scale must be positive: units per metre");
    }
  }

  void warn_if_implausible(const DepthFrame& frame) const {
    const std::optional<double> median = median_depth(frame);
    if (warn && median && (*median < kPlausibleNear || *median > kPlausibleFar)) {
      warn(folder.string() + ": half of the first image is nearer than " + std::to_string(*median) +
           " m, which is implausible at " + fixed_number_text(units_per_metre) +
           " units per metre; is the depth scale right? (TUM data sets use 5000)");
    }
  }

  std::filesystem::path folder;
  std::vector<Entry> entries;
  CameraCalibration calibration;
  double units_per_metre;
  Rectification rectification;
  std::function<void(const std::string&)> warn;
  Image16 image;
  std::size_t position = 0;
};

DepthFolderSource::DepthFolderSource(const std::filesystem::path& folder,
                                     const SourceOptions& options)
    : impl_(std::make_unique<Impl>(folder, options)) {}

DepthFolderSource::~DepthFolderSource() = default;

bool DepthFolderSource::next(DepthFrame& frame) {
  if (impl_->position == impl_->entries.size()) {
    return false;
  }
  const Entry& entry = impl_->entries[impl_->position];
  read_png16(entry.image, impl_->image);
  impl_->rectification.check_size(impl_->image.width, impl_->image.height, entry.image.string());
  frame.depth.swap(impl_->image.pixels);
  frame.metres_per_unit = static_cast<float>(1.0 / impl_->units_per_metre);
  frame.stamp = entry.stamp;
  frame.index = impl_->position++;
  impl_->rectification.apply(frame);
  if (frame.index == 0) {
    impl_->warn_if_implausible(frame);
  }
  return true;
}

std::optional<std::size_t> DepthFolderSource::frame_count() const {
  return impl_->entries.size();
}

std::string DepthFolderSource::description() const {
  return "depth images in " + impl_->folder.string() + ", " +
         fixed_number_text(impl_->units_per_metre) + " units per metre";
}

}  // namespace lockbox

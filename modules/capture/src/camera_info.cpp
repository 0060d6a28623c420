// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/camera_info.hpp"

#include <algorithm>
#include <utility>

#include "calibration_file.hpp"
#include "camera_plausibility.hpp"
#include "image_limits.hpp"
#include "lens_distortion.hpp"

namespace lockbox {
namespace {

/// The columns or rows of the images within those of the sensor, which the matrix is for.
struct CutOut {
  int size;     ///< pixels of the image
  int offset;   ///< pixels of the sensor before the first
  int binning;  ///< pixels of the sensor that make one of the image
};

/// `binning_x`, `roi.x_offset` and their like of a message; 0, or none, means the whole sensor.
CutOut cut_out(const CalibrationFile& file, int full, const char* binning, const char* offset,
               const char* extent) {
  CutOut result{full, 0, 1};
  if (const auto value = file.find({binning})) {
    result.binning = std::max(1, CalibrationFile::pixels(*value, binning, 0));
  }
  const auto roi = file.find({"roi"});
  const auto first = roi ? roi->find(offset) : std::nullopt;
  const auto part = roi ? roi->find(extent) : std::nullopt;
  if (first && part) {
    result.offset = CalibrationFile::pixels(*first, offset, 0);
    const int pixels = CalibrationFile::pixels(*part, extent, 0);
    result.size = pixels > 0 ? pixels : full;
  }
  result.size /= result.binning;
  return result;
}

std::vector<double> numbers_of(const YamlValue& matrix) {
  const std::vector<double> k = CalibrationFile::numbers(matrix, "camera_matrix");
  if (k.size() != 9) {
    matrix.refuse("camera_matrix needs 9 numbers, has " + std::to_string(k.size()));
  }
  if (std::all_of(k.begin(), k.end(), [](double value) { return value == 0.0; })) {
    matrix.refuse("camera_matrix is all 0, as of a camera that was never calibrated");
  }
  if (!(k[0] > 0.0) || !(k[4] > 0.0)) {
    matrix.refuse("camera_matrix has a focal length that is not positive");
  }
  if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    matrix.refuse("camera_matrix is not of the form [fx 0 cx; 0 fy cy; 0 0 1]");
  }
  return k;
}

PinholeCamera camera_of(const CalibrationFile& file) {
  const YamlValue matrix = file.entry({"camera_matrix", "K", "k"});
  const std::vector<double> k = numbers_of(matrix);
  const YamlValue width = file.entry({"image_width", "width"});
  const YamlValue height = file.entry({"image_height", "height"});
  const CutOut across = cut_out(file, CalibrationFile::pixels(width, "image_width", 1), "binning_x",
                                "x_offset", "width");
  const CutOut down = cut_out(file, CalibrationFile::pixels(height, "image_height", 1), "binning_y",
                              "y_offset", "height");
  const PinholeCamera camera{across.size,
                             down.size,
                             k[0] / across.binning,
                             k[4] / down.binning,
                             (k[2] - across.offset) / across.binning,
                             (k[5] - down.offset) / down.binning};
  if (camera.width < 1 || camera.height < 1 ||
      !is_image_size(static_cast<std::uint64_t>(camera.width),
                     static_cast<std::uint64_t>(camera.height))) {
    width.refuse("image_width and image_height are not those of an image of at most " +
                 std::to_string(kMaximumImagePixels) + " pixels");
  }
  if (const std::optional<std::string> problem = impossible_focal_length(camera)) {
    matrix.refuse(*problem);
  }
  if (const std::optional<std::string> problem = impossible_principal_point(camera)) {
    matrix.refuse(*problem);
  }
  return camera;
}

}  // namespace

bool CameraCalibration::has_distortion() const {
  return is_equidistant ||
         std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

CameraCalibration read_camera_info(const std::filesystem::path& file) {
  const CalibrationFile info(file);
  LensDistortion lens = read_distortion(info);
  CameraCalibration calibration{.camera = camera_of(info),
                                .distortion = std::move(lens.coefficients),
                                .depth_scale = {},
                                .is_equidistant = lens.is_equidistant};
  if (const auto scale = info.find({"depth_scale"})) {
    calibration.depth_scale = CalibrationFile::number(*scale, "depth_scale");
    if (!(*calibration.depth_scale > 0.0)) {
      scale->refuse("depth_scale must be positive: units per metre, 1000 for millimetres");
    }
  }
  return calibration;
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <locale>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

void write_list(std::ostream& out, const std::vector<double>& values) {
  out << "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    out << (i == 0 ? "" : ", ") << fixed_number_text(values[i]);
  }
  out << "]\n";
}

const char* model_name(const CameraCalibration& calibration, std::size_t coefficients) {
  if (calibration.is_equidistant) return "equidistant";
  return coefficients > 5 ? "rational_polynomial" : "plumb_bob";
}

}  // namespace

void write_camera_info(const std::filesystem::path& file, const CameraCalibration& calibration) {
  std::ofstream out(file);
  out.imbue(std::locale::classic());
  const PinholeCamera& camera = calibration.camera;
  out << "image_width: " << camera.width << "\nimage_height: " << camera.height
      << "\ncamera_name: depth\n";
  if (calibration.depth_scale) {
    out << "depth_scale: " << fixed_number_text(*calibration.depth_scale) << "\n";
  }
  out << "camera_matrix:\n  rows: 3\n  cols: 3\n  data: ";
  write_list(out, {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1});
  std::vector<double> distortion = calibration.distortion;
  if (!calibration.is_equidistant) distortion.resize(distortion.size() > 5 ? 8 : 5);
  out << "distortion_model: " << model_name(calibration, distortion.size())
      << "\ndistortion_coefficients:\n  rows: 1\n  cols: " << distortion.size() << "\n  data: ";
  write_list(out, distortion);
  out.flush();
  if (!out) {
    throw InputError(file.string(), "cannot be written; is the folder writable, is the disk full?");
  }
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/camera_info.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <locale>

#include "image_limits.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

/// One camera_info file: finds entries and complains about them by name and line.
class CameraInfoFile {
 public:
  explicit CameraInfoFile(const std::filesystem::path& file) : file_(file.string()) {
    if (!std::filesystem::is_regular_file(file)) {
      throw InputError(file_,
                       "no such file; a camera calibration (ROS camera_info.yaml) is needed");
    }
    try {
      root_ = YAML::LoadFile(file_);
    } catch (const YAML::Exception& error) {
      throw InputError(file_, error.mark.line + 1, "is not valid YAML (" + error.msg + ")");
    }
    if (!root_.IsMap()) {
      throw InputError(file_, "is not a camera calibration: no entries such as image_width");
    }
  }

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& problem) const {
    throw InputError(file_, node.Mark().line + 1, problem);
  }

  YAML::Node entry(const char* name) const {
    const YAML::Node node = root_[name];
    if (!node || node.IsNull()) {
      throw InputError(file_, std::string("the entry ") + name + " is missing");
    }
    return node;
  }

  bool has(const char* name) const { return root_[name] && !root_[name].IsNull(); }

  double number(const YAML::Node& node, const std::string& name) const {
    const std::optional<double> value =
        node.IsScalar() ? parse_finite_number(node.Scalar()) : std::nullopt;
    if (!value) {
      refuse(node, name + " is not a number");
    }
    return *value;
  }

  int size(const char* name) const {
    const YAML::Node node = entry(name);
    const double value = number(node, name);
    if (value != static_cast<int>(value) || value < 1 || value > kMaximumImageSize) {
      refuse(node, std::string(name) + " is not a size in pixels");
    }
    return static_cast<int>(value);
  }

  /// The `data` list of a matrix entry.
  std::vector<double> data(const char* name) const {
    const YAML::Node node = entry(name);
    const YAML::Node list = node.IsMap() ? node["data"] : node;
    if (!list || !list.IsSequence()) {
      refuse(node, std::string(name) + " has no list of numbers named data");
    }
    std::vector<double> values;
    for (const YAML::Node& item : list) {
      values.push_back(number(item, name));
    }
    return values;
  }

 private:
  std::string file_;
  YAML::Node root_;
};

PinholeCamera camera_of(const CameraInfoFile& file) {
  const std::vector<double> k = file.data("camera_matrix");
  const YAML::Node node = file.entry("camera_matrix");
  if (k.size() != 9) {
    file.refuse(node, "camera_matrix needs 9 numbers, has " + std::to_string(k.size()));
  }
  if (!(k[0] > 0.0) || !(k[4] > 0.0)) {
    file.refuse(node, "camera_matrix has a focal length that is not positive");
  }
  if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    file.refuse(node, "camera_matrix is not of the form [fx 0 cx; 0 fy cy; 0 0 1]");
  }
  return {file.size("image_width"), file.size("image_height"), k[0], k[4], k[2], k[5]};
}

std::vector<double> distortion_of(const CameraInfoFile& file) {
  if (!file.has("distortion_coefficients")) {
    return {};
  }
  std::vector<double> values = file.data("distortion_coefficients");
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; })) {
    return {};
  }
  const std::string model = file.has("distortion_model") ? file.entry("distortion_model").Scalar()
                                                         : std::string("plumb_bob");
  const std::size_t expected = model == "plumb_bob" ? 5 : model == "rational_polynomial" ? 8 : 0;
  if (expected == 0) {
    file.refuse(file.entry("distortion_model"),
                "distortion model " + model +
                    " is not supported (plumb_bob and rational_polynomial are); rectify the images "
                    "first and set the coefficients to 0");
  }
  if (values.size() != expected) {
    file.refuse(file.entry("distortion_coefficients"),
                model + " needs " + std::to_string(expected) + " coefficients, found " +
                    std::to_string(values.size()));
  }
  return values;
}

void write_list(std::ostream& out, const std::vector<double>& values) {
  out << "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    out << (i == 0 ? "" : ", ") << fixed_number_text(values[i]);
  }
  out << "]\n";
}

}  // namespace

bool CameraCalibration::has_distortion() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

CameraCalibration read_camera_info(const std::filesystem::path& file) {
  const CameraInfoFile info(file);
  CameraCalibration calibration{
      .camera = camera_of(info), .distortion = distortion_of(info), .depth_scale = {}};
  if (info.has("depth_scale")) {
    const YAML::Node node = info.entry("depth_scale");
    calibration.depth_scale = info.number(node, "depth_scale");
    if (!(*calibration.depth_scale > 0.0)) {
      info.refuse(node, "depth_scale must be positive: units per metre, 1000 for millimetres");
    }
  }
  return calibration;
}

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
  distortion.resize(distortion.size() > 5 ? 8 : 5);
  out << "distortion_model: " << (distortion.size() > 5 ? "rational_polynomial" : "plumb_bob")
      << "\ndistortion_coefficients:\n  rows: 1\n  cols: " << distortion.size() << "\n  data: ";
  write_list(out, distortion);
  out.flush();
  if (!out) {
    throw InputError(file.string(), "cannot be written; is the folder writable, is the disk full?");
  }
}

}  // namespace lockbox

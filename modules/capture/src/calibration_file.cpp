// SPDX-License-Identifier: BSD-3-Clause
#include "calibration_file.hpp"

#include <fstream>
#include <iterator>

#include "image_limits.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr std::uintmax_t kMaximumCalibrationBytes = 1U << 20U;  // a calibration has some hundreds

std::string text_of(const std::filesystem::path& file) {
  if (!is_file(file)) {
    throw InputError(file.string(),
                     "no such file; a camera calibration (ROS camera_info.yaml) is needed");
  }
  if (std::filesystem::file_size(file) > kMaximumCalibrationBytes) {
    throw InputError(file.string(), "is too large for a camera calibration (ROS camera_info.yaml)");
  }
  std::ifstream in(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  constexpr std::string_view kOpenCv = "%YAML:";  // its first line, which is no YAML
  if (text.compare(0, kOpenCv.size(), kOpenCv) == 0) {
    text.front() = '#';
  }
  return text;
}

}  // namespace

CalibrationFile::CalibrationFile(const std::filesystem::path& file) : file_(file.string()) {
  const std::string text = text_of(file);
  try {
    root_ = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file_, error.mark.line + 1, "is not valid YAML (" + error.msg + ")");
  }
  if (!root_.IsMap()) {
    throw InputError(file_, "is not a camera calibration: no entries such as image_width");
  }
}

void CalibrationFile::refuse(const YAML::Node& node, const std::string& problem) const {
  throw InputError(file_, node.Mark().line + 1, problem);
}

YAML::Node CalibrationFile::find(const std::vector<const char*>& names) const {
  for (const char* const name : names) {
    const YAML::Node node = root_[name];
    if (node && !node.IsNull()) {
      return node;
    }
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

YAML::Node CalibrationFile::entry(const std::vector<const char*>& names) const {
  const YAML::Node node = find(names);
  if (!node) {
    throw InputError(file_, std::string("the entry ") + names.front() + " is missing");
  }
  return node;
}

double CalibrationFile::number(const YAML::Node& node, const std::string& name) const {
  const std::optional<double> value =
      node.IsScalar() ? parse_finite_number(node.Scalar()) : std::nullopt;
  if (!value) {
    refuse(node, name + " is not a number");
  }
  return *value;
}

int CalibrationFile::pixels(const YAML::Node& node, const std::string& name, int minimum) const {
  const double value = number(node, name);
  if (!(value >= minimum && value <= kMaximumImageSize) || value != static_cast<int>(value)) {
    refuse(node, name + " is not a size in pixels");
  }
  return static_cast<int>(value);
}

std::vector<double> CalibrationFile::numbers(const YAML::Node& node,
                                             const std::string& name) const {
  const YAML::Node list = node.IsMap() ? node["data"] : node;
  if (!list || !list.IsSequence()) {
    refuse(node, name + " has no list of numbers named data");
  }
  std::vector<double> values;
  for (const YAML::Node& item : list) {
    values.push_back(number(item, name));
  }
  return values;
}

}  // namespace lockbox

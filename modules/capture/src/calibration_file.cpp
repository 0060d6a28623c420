// SPDX-License-Identifier: BSD-3-Clause
#include "calibration_file.hpp"

#include <fstream>
#include <iterator>
#include <utility>

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

CalibrationFile::CalibrationFile(const std::filesystem::path& file)
    : file_(file.string()), root_(YamlValue::parse(file_, text_of(file))) {
  if (!root_.is_map()) {
    throw InputError(file_, "is not a camera calibration: no entries such as image_width");
  }
}

std::optional<YamlValue> CalibrationFile::find(const std::vector<const char*>& names) const {
  for (const char* const name : names) {
    if (auto value = root_.find(name)) return value;
  }
  return std::nullopt;
}

YamlValue CalibrationFile::entry(const std::vector<const char*>& names) const {
  auto value = find(names);
  if (!value) {
    throw InputError(file_, std::string("the entry ") + names.front() + " is missing");
  }
  return *std::move(value);
}

double CalibrationFile::number(const YamlValue& value, const std::string& name) {
  const auto number = value.is_plain() ? parse_finite_number(value.text()) : std::nullopt;
  if (!number) value.refuse(name + " is not a number");
  return *number;
}

int CalibrationFile::pixels(const YamlValue& value, const std::string& name, int minimum) {
  const double size = number(value, name);
  if (!(size >= minimum && size <= kMaximumImageSize) || size != static_cast<int>(size)) {
    value.refuse(name + " is not a size in pixels");
  }
  return static_cast<int>(size);
}

std::vector<double> CalibrationFile::numbers(const YamlValue& value, const std::string& name) {
  const std::optional<YamlValue> list = value.is_map() ? value.find("data") : value;
  if (!list || !list->is_list()) value.refuse(name + " has no list of numbers named data");
  std::vector<double> numbers;
  for (const YamlValue& item : list->items()) numbers.push_back(number(item, name));
  return numbers;
}

}  // namespace lockbox

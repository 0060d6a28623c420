// SPDX-License-Identifier: BSD-3-Clause
#include "lens_distortion.hpp"

#include <algorithm>
#include <utility>

namespace lockbox {
namespace {

constexpr std::size_t kShort = 4;  // k1 k2 p1 p2: OpenCV's shortest list
constexpr std::size_t kPlumbBob = 5;
constexpr std::size_t kRational = 8;
constexpr std::size_t kEquidistant = 4;  // k1 k2 k3 k4

bool all_zero(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::all_of(begin, end, [](double value) { return value == 0.0; });
}

/// OpenCV writes no name; its list of eight is the rational polynomial.
std::string model_of(const CalibrationFile& file, std::size_t coefficients) {
  const auto named = file.find({"distortion_model"});
  if (named && named->is_plain() && !named->text().empty()) return named->text();
  return coefficients >= kRational ? "rational_polynomial" : "plumb_bob";
}

/// One model under the names that ROS 1, ROS 2 and others give it.
bool is_fisheye(const std::string& model) {
  return model == "equidistant" || model == "fisheye" || model == "kannala_brandt4";
}

void refuse_model(const CalibrationFile& file, const std::string& model) {
  file.entry({"distortion_model"})
      .refuse("distortion model " + model +
              " is not supported (plumb_bob, rational_polynomial and equidistant are); rectify the "
              "images first, give the camera of the rectified ones, and set the coefficients to 0");
}

LensDistortion equidistant(const CalibrationFile& file, const std::optional<YamlValue>& list,
                           std::vector<double> values) {
  if (values.size() != kEquidistant) {
    (list ? *list : file.entry({"distortion_model"}))
        .refuse("equidistant needs 4 coefficients, found " + std::to_string(values.size()));
  }
  return {std::move(values), true};
}

}  // namespace

LensDistortion read_distortion(const CalibrationFile& file) {
  const auto list = file.find({"distortion_coefficients", "D", "d"});
  std::vector<double> values =
      list ? CalibrationFile::numbers(*list, "distortion_coefficients") : std::vector<double>();
  const std::string model = model_of(file, values.size());
  if (is_fisheye(model)) return equidistant(file, list, std::move(values));
  if (!list || all_zero(values.begin(), values.end())) return {};
  if (model != "plumb_bob" && model != "rational_polynomial") {
    refuse_model(file, model);
  }
  const std::size_t known = model == "plumb_bob" ? kPlumbBob : kRational;
  if (values.size() < kShort) {
    list->refuse(model + " needs " + std::to_string(known) + " coefficients, found " +
                 std::to_string(values.size()));
  }
  if (values.size() > known &&
      !all_zero(values.begin() + static_cast<std::ptrdiff_t>(known), values.end())) {
    list->refuse(model + " has " + std::to_string(known) + " coefficients, and here are " +
                 std::to_string(values.size()) + " that are not 0; " +
                 (model == "plumb_bob" && values.size() == kRational
                      ? "eight belong to distortion_model: rational_polynomial"
                      : "rectify the images first and set the coefficients to 0"));
  }
  values.resize(known);
  return {std::move(values), false};
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "published_figures.hpp"

#include <limits>

#include "lockbox/core/yaml_map.hpp"

namespace lockbox::app {
namespace {

constexpr double kNotRecorded = std::numeric_limits<double>::quiet_NaN();

std::string word(const YamlMap& map, const char* key) {
  map.require(key);
  std::string value;
  map.read(key, value);
  return value;
}

double number(const YamlMap& map, const char* key) {
  double value = kNotRecorded;
  map.read(key, value);
  return value;
}

ErrorSummary read_errors(const YamlMap& row, const char* key) {
  row.require(key);
  const YamlMap map(row.value(key), {"median", "percentile_95", "maximum"});
  return {number(map, "median"), number(map, "percentile_95"), number(map, "maximum")};
}

AccuracyRow read_accuracy(const YamlValue& value) {
  const YamlMap row(value,
                    {"sequence", "tracker", "base_mm", "base_degrees", "door_degrees", "slide_mm"});
  return {word(row, "sequence"),
          word(row, "tracker"),
          read_errors(row, "base_mm"),
          read_errors(row, "base_degrees"),
          read_errors(row, "door_degrees"),
          read_errors(row, "slide_mm")};
}

TimeRow read_times(const YamlValue& value) {
  const YamlMap row(value, {"tracker", "median_ms", "percentile_95_ms", "cpu_median_ms"});
  return {word(row, "tracker"), number(row, "median_ms"), number(row, "percentile_95_ms"),
          number(row, "cpu_median_ms")};
}

CaptureRow read_capture(const YamlValue& value) {
  const YamlMap row(value, {"kind", "fast", "best"});
  return {word(row, "kind"), word(row, "fast"), word(row, "best")};
}

FastMotionRow read_fast_motion(const YamlValue& value) {
  const YamlMap row(value, {"every", "fast", "best"});
  row.require("every");
  return {static_cast<int>(number(row, "every")), word(row, "fast"), word(row, "best")};
}

}  // namespace

PublishedFigures read_published_figures(const std::filesystem::path& file) {
  const YamlMap map(YamlValue::load(file, "YAML"), {"tracker", "source", "measured", "settings",
                                                    "accuracy", "times", "capture", "fast_motion"});
  PublishedFigures figures;
  for (const auto& row : map.items("accuracy")) figures.accuracy.push_back(read_accuracy(row));
  for (const auto& row : map.items("times")) figures.times.push_back(read_times(row));
  for (const auto& row : map.items("capture")) figures.capture.push_back(read_capture(row));
  for (const auto& row : map.items("fast_motion")) {
    figures.fast_motion.push_back(read_fast_motion(row));
  }
  return figures;
}

}  // namespace lockbox::app

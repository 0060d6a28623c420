// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/depth_mode.hpp"

#include <charconv>
#include <string_view>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr double kMillimetre = 0.001;
constexpr double kTenth = 0.0001;

/// Takes a positive number off the beginning, and what must follow it; 0 if that is not there.
int take_number(std::string_view& text, std::string_view end) {
  int number = 0;
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  if (problem != std::errc() || number < 1 || !text.starts_with(end)) return 0;
  text.remove_prefix(end.size());
  return number;
}

std::string unit_text(double metres_per_unit) {
  return metres_per_unit == kTenth ? ",100um" : ",1mm";
}

std::string size_and_rate(int width, int height, int rate) {
  return std::to_string(width) + 'x' + std::to_string(height) + '@' + std::to_string(rate);
}

}  // namespace

WantedMode parse_depth_mode(const std::string& text) {
  std::string_view rest = text;
  WantedMode mode;
  mode.width = take_number(rest, "x");
  mode.height = take_number(rest, "@");
  mode.frames_per_second = take_number(rest, "");
  if (rest == ",1mm") mode.metres_per_unit = kMillimetre;
  if (rest == ",100um") mode.metres_per_unit = kTenth;
  const bool is_unit_known = rest.empty() || mode.metres_per_unit;
  if (mode.width < 1 || mode.height < 1 || mode.frames_per_second < 1 || !is_unit_known) {
    throw InputError(text,
                     "is not a mode; give WIDTHxHEIGHT@RATE, and ,1mm or ,100um behind it where "
                     "the unit matters, such as 640x480@30 or 320x240@60,100um");
  }
  return mode;
}

std::string to_string(const DepthMode& mode) {
  return size_and_rate(mode.width, mode.height, mode.frames_per_second) +
         unit_text(mode.metres_per_unit);
}

std::string to_string(const WantedMode& mode) {
  return size_and_rate(mode.width, mode.height, mode.frames_per_second) +
         (mode.metres_per_unit ? unit_text(*mode.metres_per_unit) : "");
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_origin.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "lockbox/core/number_text.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox {
namespace {

/// No rotation needs more than a turn: a larger angle was hardly meant in radians.
void warn_of_degrees(const XmlElement& origin, const std::vector<double>& rpy,
                     std::vector<std::string>& warnings) {
  constexpr double kRounding = 1.01;
  const auto largest = std::max_element(
      rpy.begin(), rpy.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (std::abs(*largest) <= kRounding * kFullTurn) return;
  warnings.push_back(origin.remark("'rpy' holds " + readable_number(*largest, 6) +
                                   ", and is in radians: if degrees are meant, write " +
                                   readable_number(kRadians * *largest, 6)));
}

}  // namespace

void write_numbers(tinyxml2::XMLPrinter& out, const char* name, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : " ").append(number_text(value));
  out.PushAttribute(name, text.c_str());
}

void copy_origin(const XmlElement& parent, std::vector<std::string>& warnings,
                 tinyxml2::XMLPrinter& out) {
  const auto origin = parent.child("origin");
  if (!origin) return;
  if (origin->attribute("quat_xyzw")) {
    origin->refuse("<origin> with 'quat_xyzw' is not supported; write the rotation as 'rpy'");
  }
  out.OpenElement("origin");
  if (const auto xyz = origin->numbers("xyz", 3)) {
    for (const double value : *xyz) {
      if (std::abs(value) > kLargestLength) origin->refuse("'xyz' is beyond a million metres");
    }
    write_numbers(out, "xyz", *xyz);
  }
  if (const auto rpy = origin->numbers("rpy", 3)) {
    warn_of_degrees(*origin, *rpy, warnings);
    write_numbers(out, "rpy", *rpy);
  }
  out.CloseElement();
}

}  // namespace lockbox

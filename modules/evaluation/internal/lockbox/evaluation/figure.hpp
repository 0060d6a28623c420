// SPDX-License-Identifier: BSD-3-Clause
// Line plots and heat maps, drawn by gnuplot where it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lockbox {

struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x; NaN makes a gap
};

/// One coloured cell around each point (x, y) of a grid.
struct HeatMap {
  std::string label;  ///< of the colour scale
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> values;  ///< x.size() * y.size(), all x of the first y first
  double lowest = 0.0;         ///< values at the ends of the colour scale
  double highest = 100.0;
};

struct Panel {
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  bool logarithmic_y = false;
  std::string title = {};
  std::optional<HeatMap> heat_map = std::nullopt;  ///< behind the curves
};

/// Panels one below the other.
struct Figure {
  std::string title;
  std::vector<Panel> panels;
};

/// Writes <stem>.gp, a gnuplot script with the data in it, and lets gnuplot make <stem>.png and
/// <stem>.svg from it. Panels without a finite value are left out. Returns what prevented it
/// (gnuplot is not installed, or failed), or nothing. Throws InputError if the script cannot be
/// written.
std::string write_figure(const std::filesystem::path& stem, const Figure& figure);

}  // namespace lockbox

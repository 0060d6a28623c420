// SPDX-License-Identifier: BSD-3-Clause
// Line plots, drawn by gnuplot where it is installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x; NaN makes a gap
};

struct Panel {
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  bool logarithmic_y = false;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/figure.hpp"
#include "lockbox/core/number_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "output_file.hpp"
#include "process.hpp"

namespace lockbox {
namespace {

/// A gnuplot string: between single quotes only these are special.
std::string quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

bool has_value(const Panel& panel) {
  if (panel.heat_map) return true;
  return std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
  });
}

std::string data_name(std::size_t panel, std::size_t curve) {
  return "$data_" + std::to_string(panel) + "_" + std::to_string(curve);
}

std::string map_name(std::size_t panel) {
  return "$map_" + std::to_string(panel);
}

/// The ends of a cell: half way to its neighbours.
std::pair<double, double> cell_ends(const std::vector<double>& centres, std::size_t i) {
  const std::size_t last = centres.size() - 1;
  if (last == 0) return {centres[0] - 0.5, centres[0] + 0.5};
  const double before =
      0.5 * (centres[i] - (i > 0 ? centres[i - 1] : 2.0 * centres[0] - centres[1]));
  const double after =
      0.5 * ((i < last ? centres[i + 1] : 2.0 * centres[last] - centres[last - 1]) - centres[i]);
  return {centres[i] - before, centres[i] + after};
}

/// Rows `x y x_begin x_end y_begin y_end value`.
void write_map(std::ostream& out, const HeatMap& map, std::size_t panel) {
  assert(map.values.size() == map.x.size() * map.y.size());
  out << map_name(panel) << " << END\n";
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const std::size_t column = i % map.x.size();
    const std::size_t row = i / map.x.size();
    const auto [left, right] = cell_ends(map.x, column);
    const auto [low, high] = cell_ends(map.y, row);
    for (const double value : {map.x[column], map.y[row], left, right, low, high, map.values[i]}) {
      out << number_text(value) << ' ';
    }
    out << '\n';
  }
  out << "END\n";
}

void write_data(std::ostream& out, const std::vector<Panel>& panels) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (panels[p].heat_map) write_map(out, *panels[p].heat_map, p);
    for (std::size_t c = 0; c < panels[p].curves.size(); ++c) {
      const Curve& curve = panels[p].curves[c];
      assert(curve.x.size() == curve.y.size());
      out << data_name(p, c) << " << END\n";
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        out << number_text(curve.x[i]) << ' ' << number_text(curve.y[i]) << '\n';
      }
      out << "END\n";
    }
  }
}

void write_panel(std::ostream& out, const Panel& panel, std::size_t index) {
  out << "set xlabel " << quoted(panel.x_label) << "\nset ylabel " << quoted(panel.y_label) << '\n'
      << (panel.logarithmic_y ? "set" : "unset") << " logscale y\nset title " << quoted(panel.title)
      << '\n';
  if (panel.heat_map) {
    const HeatMap& map = *panel.heat_map;
    out << "set cblabel " << quoted(map.label) << "\nset cbrange [" << map.lowest << ':'
        << map.highest << "]\nset autoscale fix\nplot " << map_name(index)
        << " using 1:2:3:4:5:6:7 with boxxyerror fillcolor palette fillstyle solid 1 noborder"
           " notitle";
  } else {
    out << "set autoscale keepfix\nplot ";
  }
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    out << (c == 0 && !panel.heat_map ? "" : ", ") << data_name(index, c)
        << " using 1:2 with lines title " << quoted(panel.curves[c].name);
  }
  out << '\n';
}

void write_drawing(std::ostream& out, const Figure& figure, const std::vector<Panel>& panels,
                   const std::string& terminal, const std::filesystem::path& image) {
  out << "set terminal " << terminal << " noenhanced size 960," << 360 * panels.size()
      << "\nset output " << quoted(image.string()) << "\nset multiplot layout " << panels.size()
      << ",1 title " << quoted(figure.title) << '\n';
  for (std::size_t p = 0; p < panels.size(); ++p) write_panel(out, panels[p], p);
  out << "unset multiplot\nunset output\n";
}

std::filesystem::path with_suffix(std::filesystem::path stem, const char* suffix) {
  return stem += suffix;
}

}  // namespace

std::string write_figure(const std::filesystem::path& stem, const Figure& figure) {
  std::vector<Panel> panels;
  std::copy_if(figure.panels.begin(), figure.panels.end(), std::back_inserter(panels), has_value);
  if (panels.empty()) return "nothing to plot in " + stem.filename().string();
  const std::filesystem::path script = with_suffix(stem, ".gp");
  OutputFile file(script);
  std::ostream& out = file.stream();
  write_data(out, panels);
  out << "set key outside right\nset grid\nset lmargin 12\nset rmargin 30\n"
      << "set palette defined (0 '#440154', 1 '#31688e', 2 '#35b779', 3 '#fde725')\n";
  const std::filesystem::path png = std::filesystem::absolute(with_suffix(stem, ".png"));
  write_drawing(out, figure, panels, "pngcairo", png);
  write_drawing(out, figure, panels, "svg", std::filesystem::path(png).replace_extension(".svg"));
  file.close();
  switch (run_quietly("gnuplot", {std::filesystem::absolute(script).string()})) {
    case ProcessResult::succeeded:
      return {};
    case ProcessResult::not_found:
      return "gnuplot is not installed (Debian: gnuplot-nox): no picture of " + script.string();
    case ProcessResult::failed:
      break;
  }
  return "gnuplot failed on " + script.string() + "; run it there to see why";
}

}  // namespace lockbox

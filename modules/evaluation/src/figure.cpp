// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/figure.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "csv_fields.hpp"
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
  return std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
  });
}

std::string data_name(std::size_t panel, std::size_t curve) {
  return "$data_" + std::to_string(panel) + "_" + std::to_string(curve);
}

void write_data(std::ostream& out, const std::vector<Panel>& panels) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (std::size_t c = 0; c < panels[p].curves.size(); ++c) {
      const Curve& curve = panels[p].curves[c];
      assert(curve.x.size() == curve.y.size());
      out << data_name(p, c) << " << END\n";
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        out << field_text(curve.x[i]) << ' ' << field_text(curve.y[i]) << '\n';
      }
      out << "END\n";
    }
  }
}

void write_panel(std::ostream& out, const Panel& panel, std::size_t index) {
  out << "set xlabel " << quoted(panel.x_label) << "\nset ylabel " << quoted(panel.y_label) << '\n'
      << (panel.logarithmic_y ? "set" : "unset") << " logscale y\nplot ";
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    out << (c == 0 ? "" : ", ") << data_name(index, c) << " using 1:2 with lines title "
        << quoted(panel.curves[c].name);
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
  out << "set key outside right\nset grid\nset lmargin 12\nset rmargin 30\n";
  const std::filesystem::path png = std::filesystem::absolute(with_suffix(stem, ".png"));
  write_drawing(out, figure, panels, "pngcairo", png);
  write_drawing(out, figure, panels, "svg", std::filesystem::path(png).replace_extension(".svg"));
  file.close();
  switch (run_quietly("gnuplot", {std::filesystem::absolute(script).string()})) {
    case ProcessResult::succeeded:
      return {};
    case ProcessResult::not_found:
      return "gnuplot is not installed: no picture of " + script.string();
    case ProcessResult::failed:
      break;
  }
  return "gnuplot failed on " + script.string() + "; run it there to see why";
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include <deque>
#include <vector>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The text of a scene but for its overlay, its colour scale and its legend.
class Captions {
 public:
  /// scale: of the texts' size.
  Captions(vtkRenderer& renderer, double scale);

  void set(const DisplayedScene& scene);

 private:
  void set_scale(const DisplayedScene& scene);
  void set_legend(const std::vector<LegendEntry>& legend);
  void add_legend_line();

  /// A line of the legend: a patch of the colour, and what it stands for.
  struct LegendLine {
    vtkNew<vtkTextActor> patch;
    vtkNew<vtkTextActor> name;
  };

  vtkRenderer& renderer_;
  double scale_factor_;

  vtkNew<vtkTextActor> status_;
  vtkNew<vtkTextActor> help_;
  vtkNew<vtkScalarBarActor> scale_;
  std::deque<LegendLine> legend_;  ///< as many as were ever needed
};

}  // namespace lockbox

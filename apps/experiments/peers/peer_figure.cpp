// SPDX-License-Identifier: BSD-3-Clause
#include "peer_figure.hpp"

#include <cmath>

#include "peer_measures.hpp"
#include "peer_scene.hpp"

namespace lockbox::app {
namespace {

/// Returns of each frame the median over the runs.
Curve typical_curve(const std::string& name, const std::vector<PeerRun>& runs,
                    const Measure& measure) {
  Curve curve{name, {}, {}};
  for (std::size_t i = 0; i < runs.front().frames.size(); ++i) {
    std::vector<double> values;
    for (const PeerRun& run : runs) {
      const double value = measure(run.frames[i]);
      if (std::isfinite(value)) values.push_back(value);
    }
    curve.x.push_back(static_cast<double>(i));
    curve.y.push_back(median(values));
  }
  return curve;
}

Panel error_panel(const std::string& label, const std::vector<PeerRun>& runs,
                  const Measure& measure, const PublishedFigures& published,
                  ErrorSummary AccuracyRow::*part) {
  Panel panel{"frame", label, {}, true};
  double last = 0.0;
  for (const PeerSequence& sequence : peer_sequences()) {
    const auto own = selected(runs, peer_settings().front().name, sequence.name);
    if (own.empty()) continue;
    panel.curves.push_back(typical_curve(sequence.name, own, measure));
    last = panel.curves.back().x.back();
  }
  for (const AccuracyRow& row : published.accuracy) {
    if (row.sequence != "static" || row.tracker != "M3T best") continue;
    const ErrorSummary& errors = row.*part;
    panel.curves.push_back(
        {"M3T best, static: median", {0.0, last}, {errors.median, errors.median}});
    panel.curves.push_back(
        {"M3T best, static: maximum", {0.0, last}, {errors.maximum, errors.maximum}});
  }
  return panel;
}

}  // namespace

Figure peer_figure(const std::string& name, const std::vector<PeerRun>& runs,
                   const PublishedFigures& published) {
  return {name + ": errors on the scene on which M3T was measured, medians over the seeds",
          {error_panel("base (mm)", runs, base_mm, published, &AccuracyRow::base_mm),
           error_panel("base (degrees)", runs, base_degrees, published, &AccuracyRow::base_degrees),
           error_panel("door (degrees)", runs, door_degrees, published, &AccuracyRow::door_degrees),
           error_panel("slide (mm)", runs, slide_mm, published, &AccuracyRow::slide_mm)}};
}

}  // namespace lockbox::app

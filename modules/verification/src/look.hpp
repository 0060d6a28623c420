// SPDX-License-Identifier: BSD-3-Clause
// What an image says for a configuration, in cells of one width.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "cell_classification.hpp"
#include "contour_lines.hpp"
#include "faint_steps.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/verification/evidence.hpp"
#include "lockbox/verification/evidence_options.hpp"
#include "scene_cells.hpp"
#include "sensor_window.hpp"

namespace lockbox {

/// Reuses its buffers. The tree must outlive it.
class Look {
 public:
  /// columns: of the cells that the image is cut into.
  Look(const KinematicTree& tree, const EvidenceOptions& options, int columns);

  /// See Verifier::look_at(). shift: the share of a cell by which the first begins after the
  /// image's corner, in [0, 1).
  void look_at(const TiledCloud& cloud, const SensorNoise& sensor, const Executor& executor,
               double shift = 0.0);

  /// Returns the evidence in the image looked at last.
  Evidence evidence(const Configuration& configuration);

 private:
  /// Of a row of cells, or of all.
  struct Sums {
    Evidence evidence;
    double unmatched = 0.0;          ///< nats of the scene's lines that the model has not
    std::vector<UnseenCell> unseen;  ///< of the model's lines

    void clear() {
      evidence = {};
      unmatched = 0.0;
      unseen.clear();
    }
    Sums& operator+=(const Sums& other) {
      evidence += other.evidence;
      unmatched += other.unmatched;
      unseen.insert(unseen.end(), other.unseen.begin(), other.unseen.end());
      return *this;
    }
  };

  void draw(const Configuration& configuration);
  Evidence sum_up();
  double chance_of_a_line() const;
  void compare_row(int v);
  void compare_lines(int u, int v, Sums& sum) const;
  bool is_in_sight(int u, int v, const Eigen::Vector2f& direction) const;
  double of_occluder(int u, int v) const;

  const KinematicTree& tree_;
  EvidenceOptions options_;
  int columns_;
  double tolerance_;  ///< of the model, metres
  Executor executor_{1};
  std::optional<SceneCells> scene_;
  std::unique_ptr<DepthRenderer> renderer_;
  ShownModel shown_;
  CellClassification classified_;
  ContourLines scene_lines_;
  ContourLines model_lines_;
  ContourLines faint_lines_;  ///< of the model, those that are hardly ones, too
  SensorWindow window_;
  ContourLines blurred_lines_;  ///< of the model, those that a sensor's window leaves
  FaintSteps faint_steps_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<RenderItem> items_;
  std::vector<Sums> sums_;  ///< by row
};

}  // namespace lockbox

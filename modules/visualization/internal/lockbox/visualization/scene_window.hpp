// SPDX-License-Identifier: BSD-3-Clause
// The window of the 3D viewer. VTK draws it, in a component of its own (viewer/) that is loaded
// when a window is opened: whoever opens none needs none of its libraries.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox {

/// Triangles of one colour that move with a body.
struct ScenePart {
  const TriangleMesh* mesh = nullptr;  ///< in the frame of the body; is copied
  Eigen::Vector3f color;               ///< red, green, blue in [0, 1]
  std::size_t body = 0;
};

/// A step of a colour scale.
struct ScaleColor {
  double value;
  Eigen::Vector3f color;  ///< red, green, blue in [0, 1]
};

/// What a colour stands for.
struct LegendEntry {
  std::string name;
  Eigen::Vector3f color;  ///< red, green, blue in [0, 1]
};

/// A quantity that the user sets with the mouse.
struct SceneSlider {
  std::string name;
  std::string format;  ///< of the value, as printf's of a double
  double lower = 0.0;
  double upper = 1.0;
  double value = 0.0;
  std::string limits;  ///< in words; empty: nothing is said of them
};

/// Where the user has moved a slider.
struct SliderMove {
  std::optional<std::size_t> slider;  ///< of the scene's sliders; none: the seek bar
  double value;
};

/// The model once more, translucent and in one colour.
struct SceneGhost {
  std::vector<Eigen::Isometry3d> T_camera_body;  ///< by body
  Eigen::Vector3f color;                         ///< red, green, blue in [0, 1]
};

/// What a window shows, in the depth camera's optical frame (metres).
struct DisplayedScene {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint8_t> point_rgb;           ///< three bytes a point
  double point_size = 1.0;                       ///< pixels of the window
  std::vector<Eigen::Isometry3d> T_camera_body;  ///< by body; empty: the model is not shown
  double model_opacity = 1.0;
  /// By part, three bytes a vertex; empty: the parts have their own colours.
  std::vector<std::vector<std::uint8_t>> part_rgb;
  std::vector<SceneGhost> ghosts;
  std::string status;                   ///< lines for the upper left corner
  std::string help;                     ///< a line for the lower left corner
  std::string overlay;                  ///< lines over the middle of the window
  std::string scale_title;              ///< of the colour scale
  std::vector<ScaleColor> scale;        ///< values at equal steps; empty: no scale is shown
  bool is_scale_logarithmic = false;    ///< then its values are at equal ratios
  std::vector<LegendEntry> legend;      ///< for the lower right corner
  std::vector<SceneSlider> sliders;     ///< on the left; not in pictures
  std::optional<SceneSlider> seek_bar;  ///< at the bottom; not in pictures
};

/// From where a scene is seen.
struct SceneCamera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  double view_angle = 0.8;  ///< of the window's height, radians
};

/// All calls for a window, its destruction too, have to come from the thread that opened it.
class SceneWindow {
 public:
  virtual ~SceneWindow() = default;

  /// Where the mouse and the key `r` start from.
  virtual void look(const SceneCamera& camera) = 0;

  /// Draws the scene, which may change or go afterwards.
  virtual void show(const DisplayedScene& scene) = 0;

  /// Draws two side by side, seen from the same place. Sliders are those of the left one,
  /// the overlay that of either.
  virtual void show_beside(const DisplayedScene& left, const DisplayedScene& right) = 0;

  /// Handles what the user did since the last call (the mouse turns, shifts and zooms the view) and
  /// returns the keys that were pressed, by their names in X11. Does not wait.
  virtual std::vector<std::string> poll() = 0;

  /// Where sliders were moved before the last poll(), once.
  virtual std::vector<SliderMove> take_moves() = 0;

  /// False after the user has closed it, also with `q` or Escape.
  virtual bool is_open() const = 0;

  /// What was drawn last.
  virtual RgbImage picture() = 0;
};

struct WindowOptions {
  std::string title = "lockbox";
  int width = 0;   ///< pixels; 0: 1280, times the scale, and no more than the display has
  int height = 0;  ///< pixels; 0: 800, likewise
  /// Of texts and points; 0: of a visible window that of the display (its resource Xft.dpi or,
  /// without one, the dots per inch of its screen, over 96), of others 1.
  double scale = 0.0;
  bool visible = true;  ///< else only for picture(), with smooth edges
  /// Called if the display goes, in the thread of the window, which then stops for good: it must
  /// not be waited for. Without it the process ends, as is usual with X.
  std::function<void()> on_display_lost;
};

/// Throws InputError that says what to do if the component is missing or there is no display.
std::unique_ptr<SceneWindow> open_scene_window(const std::vector<ScenePart>& parts,
                                               const WindowOptions& options = {});

}  // namespace lockbox

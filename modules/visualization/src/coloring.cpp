// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/coloring.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/visualization/model_distance.hpp"
#include "lockbox/visualization/surface_sigma.hpp"

namespace lockbox {
namespace {

constexpr float kErrorRange = 0.01F;  // metres to both sides; what is farther off is grey
constexpr double kDensePoint = 2.0;   // pixels
constexpr double kSeeThrough = 0.35;  // opacity of the model among coloured points
constexpr auto kErrorTitle = "mm to model\n+ before it\n- behind it\ngrey: more";
const Eigen::Vector3f kGrey(0.37F, 0.37F, 0.37F);  // of points that are not near the model

/// Colours that are told apart, also by those who see few (Okabe and Ito, without black).
const std::array<Eigen::Vector3f, 7> kDistinct = {
    Eigen::Vector3f(0.90F, 0.62F, 0.00F), Eigen::Vector3f(0.34F, 0.71F, 0.91F),
    Eigen::Vector3f(0.00F, 0.62F, 0.45F), Eigen::Vector3f(0.94F, 0.89F, 0.26F),
    Eigen::Vector3f(0.10F, 0.45F, 0.80F), Eigen::Vector3f(0.84F, 0.37F, 0.00F),
    Eigen::Vector3f(0.80F, 0.47F, 0.65F)};

/// Returns the colour of a body. After seven bodies the same colours come again, darker.
Eigen::Vector3f color_of_body(std::size_t body) {
  const std::size_t round = body / kDistinct.size();
  return kDistinct[body % kDistinct.size()] * std::pow(0.6F, static_cast<float>(round));
}

struct TermColor {
  PixelTerm term;
  const char* name;
  Eigen::Vector3f color;
};

const std::array<TermColor, 4> kTerms = {
    TermColor{PixelTerm::points, "points: on the surface", {0.00F, 0.62F, 0.45F}},
    TermColor{PixelTerm::edges, "edges: beside an edge", {0.94F, 0.89F, 0.26F}},
    TermColor{PixelTerm::free_space, "free space: seen through", {0.84F, 0.37F, 0.00F}},
    TermColor{PixelTerm::hidden, "hidden: something before it", {0.34F, 0.71F, 0.91F}}};

constexpr double kLeastSigma = 1e-5;     // metres, at the dark end of the scale
constexpr double kGreatestSigma = 1e-2;  // at the bright end
const Eigen::Vector3f kNotDetermined(0.85F, 0.1F, 0.75F);

/// Returns a colour from dark blue over green to yellow, for shares from 0 to 1.
Eigen::Vector3f heat(float share) {
  const std::array<Eigen::Vector3f, 4> stops = {
      Eigen::Vector3f(0.15F, 0.20F, 0.50F), Eigen::Vector3f(0.12F, 0.55F, 0.55F),
      Eigen::Vector3f(0.40F, 0.78F, 0.38F), Eigen::Vector3f(0.98F, 0.90F, 0.25F)};
  const float at = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return stops[first] + (at - static_cast<float>(first)) * (stops[first + 1] - stops[first]);
}

Eigen::Vector3f color_of_sigma(float sigma) {
  if (sigma == kUndetermined) return kNotDetermined;
  const float share = std::log(std::max(sigma, 1e-9F) / static_cast<float>(kLeastSigma)) /
                      std::log(static_cast<float>(kGreatestSigma / kLeastSigma));
  return heat(share);
}

std::vector<ScaleColor> sigma_scale() {
  constexpr int kSteps = 60;
  std::vector<ScaleColor> scale;
  for (int step = 0; step <= kSteps; ++step) {
    const double share = static_cast<double>(step) / kSteps;
    scale.push_back({kMillimetres * kLeastSigma * std::pow(kGreatestSigma / kLeastSigma, share),
                     heat(static_cast<float>(share))});
  }
  return scale;
}

void append(const Eigen::Vector3f& color, std::vector<std::uint8_t>& rgb) {
  for (const float value : color) rgb.push_back(static_cast<std::uint8_t>(255.0F * value));
}

void set(std::size_t point, const Eigen::Vector3f& color, DisplayedScene& scene) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    scene.point_rgb[3 * point + channel] =
        static_cast<std::uint8_t>(255.0F * color(static_cast<Eigen::Index>(channel)));
  }
}

}  // namespace

const std::vector<std::string>& coloring_names() {
  static const std::vector<std::string> names = {"plain", "errors", "bodies", "terms",
                                                 "uncertainty"};
  return names;
}

Coloring coloring_named(const std::string& name) {
  const auto& names = coloring_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(name, "is no colouring");
  return static_cast<Coloring>(found - names.begin());
}

std::optional<Coloring> coloring_of_key(const std::string& key) {
  for (std::size_t i = 1; i < coloring_names().size(); ++i) {
    if (key == coloring_names()[i].substr(0, 1)) return static_cast<Coloring>(i);
  }
  return std::nullopt;
}

void SceneColors::paint(Coloring coloring, const DepthFrame* frame, const ShownEstimate& estimate,
                        const std::vector<Eigen::Isometry3d>& T_camera_body,
                        DisplayedScene& scene) {
  if (coloring == Coloring::plain || T_camera_body.empty()) return;
  if (coloring == Coloring::uncertainty) {
    paint_uncertainty(estimate, T_camera_body, scene);
    return;
  }
  scene.point_size = kDensePoint;
  scene.model_opacity = kSeeThrough;
  if (coloring == Coloring::errors) paint_errors(T_camera_body, scene);
  if (coloring == Coloring::bodies) paint_bodies(T_camera_body, scene);
  if (coloring == Coloring::terms && frame != nullptr) paint_terms(*frame, T_camera_body, scene);
}

void SceneColors::paint_errors(const std::vector<Eigen::Isometry3d>& T_camera_body,
                               DisplayedScene& scene) {
  model_distances(model_, T_camera_body, scene.points, kErrorRange, distances_);
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    const bool is_near = std::abs(distances_[i]) <= kErrorRange;
    set(i, is_near ? distance_color(distances_[i], kErrorRange) : kGrey, scene);
  }
  scene.scale_title = kErrorTitle;
  scene.scale = distance_scale(kErrorRange);
}

void SceneColors::paint_bodies(const std::vector<Eigen::Isometry3d>& T_camera_body,
                               DisplayedScene& scene) {
  nearest_bodies(model_, T_camera_body, scene.points, kErrorRange, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const bool is_near = bodies_[i] != kNoBody;
    set(i, is_near ? color_of_body(static_cast<std::size_t>(bodies_[i])) : kGrey, scene);
  }
  for (std::size_t body = 0; body < model_.tree.bodies.size(); ++body) {
    const auto& visuals = model_.tree.bodies[body].visuals;
    for (const auto& visual : visuals) {
      auto& rgb = scene.part_rgb.emplace_back();
      for (std::size_t i = 0; i < visual.mesh.vertices.size(); ++i) {
        append(color_of_body(body), rgb);
      }
    }
    if (!visuals.empty()) {
      scene.legend.push_back({model_.tree.bodies[body].name, color_of_body(body)});
    }
  }
}

void SceneColors::paint_terms(const DepthFrame& frame,
                              const std::vector<Eigen::Isometry3d>& T_camera_body,
                              DisplayedScene& scene) {
  for (const auto& [term, name, color] : kTerms) scene.legend.push_back({name, color});
  if (scene.points.empty()) return;  // switched off
  terms_.find(frame, T_camera_body, term_of_point_);
  for (std::size_t i = 0; i < term_of_point_.size(); ++i) {
    const auto* const found =
        std::find_if(kTerms.begin(), kTerms.end(),
                     [&](const TermColor& entry) { return entry.term == term_of_point_[i]; });
    set(i, found == kTerms.end() ? kGrey : found->color, scene);
  }
}

/// They would hide half of its colours.
void SceneColors::remove_points_of_model(const std::vector<Eigen::Isometry3d>& T_camera_body,
                                         DisplayedScene& scene) {
  model_distances(model_, T_camera_body, scene.points, kErrorRange, distances_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    if (std::abs(distances_[i]) <= kErrorRange) continue;
    scene.points[kept] = scene.points[i];
    std::copy_n(scene.point_rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                scene.point_rgb.begin() + static_cast<std::ptrdiff_t>(3 * kept));
    ++kept;
  }
  scene.points.resize(kept);
  scene.point_rgb.resize(3 * kept);
}

void SceneColors::paint_uncertainty(const ShownEstimate& estimate,
                                    const std::vector<Eigen::Isometry3d>& T_camera_body,
                                    DisplayedScene& scene) {
  if (estimate.sigma.empty() && estimate.covariance.size() == 0) {
    scene.legend.push_back({"these states tell no deviations", kGrey});
    return;
  }
  remove_points_of_model(T_camera_body, scene);
  const SurfaceSigma sigma(model_.tree, T_camera_body, estimate);
  for (std::size_t body = 0; body < model_.tree.bodies.size(); ++body) {
    for (const auto& visual : model_.tree.bodies[body].visuals) {
      auto& rgb = scene.part_rgb.emplace_back();
      for (const auto& vertex : visual.mesh.vertices) {
        append(color_of_sigma(sigma.at(body, vertex)), rgb);
      }
    }
  }
  const bool with_base = estimate.covariance.size() > 0;
  scene.scale_title = with_base ? "sigma, mm" : "sigma, mm\njoints only";
  scene.scale = sigma_scale();
  scene.is_scale_logarithmic = true;
  scene.legend.push_back({"not determined", kNotDetermined});
}

}  // namespace lockbox

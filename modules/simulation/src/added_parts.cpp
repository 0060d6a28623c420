// SPDX-License-Identifier: BSD-3-Clause
#include "added_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>

#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "scene_meshes.hpp"

namespace lockbox::simulation {
namespace {

constexpr int kMostParts = 200;           // that add_parts() tries
constexpr std::int16_t kAddedId = 20000;  // marks pixels of added parts
constexpr PinholeCamera kFrontCamera{320, 240, 575.8, 575.8, 159.5, 119.5};

/// Where a part can be put.
struct Place {
  std::size_t body;
  Eigen::Vector3d position;  ///< in the body's frame
  Eigen::Vector3d normal;
};

struct AddedPart {
  std::size_t body;
  TriangleMesh mesh;  ///< in the body's frame
};

/// The object at rest, seen from its front.
class FrontView {
 public:
  FrontView(const KinematicTree& tree, const Executor& executor)
      : tree_(tree), renderer_(kFrontCamera, executor) {
    Configuration rest = rest_configuration(tree);
    const Eigen::AlignedBox3d box = model_bounds(tree, rest);
    const double extent = std::max(box.sizes().x(), box.sizes().y());
    const double distance = extent * kFrontCamera.fx / kFrontCamera.height;
    rest.T_camera_base = facing_pose(distance) *
                         Eigen::Translation3d(-box.center().x(), -box.center().y(), -box.max().z());
    forward_kinematics(tree, rest, T_camera_body_);
  }

  std::vector<Place> visible_places();

  /// Returns their share of the pixels that show the object.
  double share_of(const std::deque<AddedPart>& parts);

 private:
  void draw(const std::deque<AddedPart>& parts);

  const KinematicTree& tree_;
  DepthRenderer renderer_;
  std::vector<Eigen::Isometry3d> T_camera_body_;
  RenderedDepth image_;
};

void FrontView::draw(const std::deque<AddedPart>& parts) {
  std::vector<RenderItem> items;
  for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
    items.push_back(body_item(tree_, b, T_camera_body_[b]));
  }
  for (const AddedPart& part : parts) {
    items.push_back({&part.mesh, T_camera_body_[part.body], kAddedId, true});
  }
  renderer_.render(items, image_);
}

std::vector<Place> FrontView::visible_places() {
  constexpr double kSamplesAlong = 40.0;  // of a square of the body's area
  constexpr double kNearness = 0.003;     // metres from what the image shows
  constexpr double kFacing = 0.7;         // cosine
  draw({});
  std::vector<Place> places;
  for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
    const double area = surface_area(tree_.bodies[b].mesh);
    if (area <= 0.0) continue;
    for (const SurfaceSample& sample :
         sample_surface(tree_.bodies[b].mesh, std::sqrt(area) / kSamplesAlong)) {
      const Eigen::Vector3d p_camera = T_camera_body_[b] * sample.position;
      const auto pixel = kFrontCamera.pixel_of(p_camera);
      if (!pixel || -(T_camera_body_[b].linear() * sample.normal).z() < kFacing) continue;
      const float seen = image_.depth[image_.index(pixel->u, pixel->v)];
      if (std::abs(seen - p_camera.z()) < kNearness) {
        places.push_back({b, sample.position, sample.normal});
      }
    }
  }
  return places;
}

double FrontView::share_of(const std::deque<AddedPart>& parts) {
  draw(parts);
  std::size_t object = 0;
  std::size_t added = 0;
  for (const std::int16_t id : image_.id) {
    object += id != kNothing ? 1 : 0;
    added += id == kAddedId ? 1 : 0;
  }
  return object > 0 ? static_cast<double>(added) / static_cast<double>(object) : 0.0;
}

/// A part with its foot in z = 0. largest: metres that it may be long or wide.
TriangleMesh drawn_part(int kind, double largest, RandomDraws& random) {
  const auto no_longer = [&](double length) { return std::min(length, largest); };
  Eigen::Vector3d size;
  if (kind == 0) {  // a padlock
    const double width = no_longer(random.uniform(0.04, 0.08));
    size = {width, no_longer(1.3 * width), random.uniform(0.03, 0.04)};
  } else if (kind == 1) {  // a cable channel
    size = {no_longer(random.uniform(0.10, 0.30)), no_longer(0.03), 0.03};
  } else {  // a knob
    const double diameter = no_longer(random.uniform(0.03, 0.06));
    size = {diameter, diameter, random.uniform(0.03, 0.05)};
  }
  const TriangleMesh mesh = kind == 2 ? make_cylinder(0.5 * size.x(), size.z()) : make_box(size);
  return transformed(mesh, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5 * size.z())));
}

AddedPart placed_part(const KinematicTree& tree, const Place& place, int kind,
                      RandomDraws& random) {
  constexpr double kQuarterTurn = 90.0 * kRadians;
  const Eigen::Vector3d extent = bounds(tree.bodies[place.body].mesh).sizes();
  Eigen::Isometry3d T_body_part = Eigen::Isometry3d::Identity();
  T_body_part.translation() = place.position;
  T_body_part.linear() = rotation_along(place.normal);
  if (random.chance(0.5)) {
    T_body_part.rotate(Eigen::AngleAxisd(kQuarterTurn, Eigen::Vector3d::UnitZ()));
  }
  return {place.body, transformed(drawn_part(kind, extent.maxCoeff(), random), T_body_part)};
}

/// One of the places on the base, or on a moving body, whichever is asked for and exists.
const Place& drawn_place(const std::vector<Place>& places, bool on_base, RandomDraws& random) {
  std::vector<const Place*> wanted;
  for (const Place& place : places) {
    if ((place.body == 0) == on_base) wanted.push_back(&place);
  }
  const auto pick = [&](std::size_t count) {
    return std::min(static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(count))),
                    count - 1);
  };
  return wanted.empty() ? places[pick(places.size())] : *wanted[pick(wanted.size())];
}

}  // namespace

void add_parts(KinematicTree& tree, int count, double share, RandomDraws& random,
               const Executor& executor) {
  if (count == 0 && share <= 0.0) return;
  FrontView view(tree, executor);
  const std::vector<Place> places = view.visible_places();
  if (places.empty()) throw InputError(tree.name, "has no front that parts could be added to");
  std::deque<AddedPart> parts;
  const int first_kind = static_cast<int>(random.uniform(0.0, 3.0));
  while (std::cmp_less(parts.size(), count) || view.share_of(parts) < share) {
    const auto number = static_cast<int>(parts.size());
    if (number == kMostParts) {
      throw InputError(tree.name, "'added_share' cannot be reached; choose a smaller one");
    }
    const Place& place = drawn_place(places, number % 2 == 0, random);
    parts.push_back(placed_part(tree, place, (first_kind + number) % 3, random));
  }
  for (const AddedPart& part : parts) append(tree.bodies[part.body].mesh, part.mesh);
}

}  // namespace lockbox::simulation

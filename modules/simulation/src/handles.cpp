// SPDX-License-Identifier: BSD-3-Clause
#include "handles.hpp"

#include <algorithm>

namespace lockbox::simulation {
namespace {

constexpr double kEdge = 0.04;          // from a door's free edge to its handle, metres
constexpr double kMostOfFront = 0.7;    // that a handle is long
constexpr double kRecessWidth = 0.035;  // of a recess, across its length, metres
constexpr double kPlate = 0.006;        // behind a recess, metres

/// Where a handle is, and how it lies: its length runs along x or along z.
struct Seat {
  Eigen::Vector3d centre;  ///< on the front's face
  bool is_upright;
  double length;

  /// Lengths along the handle, away from the front, and across both, in the link's frame.
  Eigen::Vector3d turned(double along, double out, double across) const {
    return is_upright ? Eigen::Vector3d(across, -out, along) : Eigen::Vector3d(along, -out, across);
  }
  Eigen::Vector3d at(double along, double out, double across = 0.0) const {
    return centre + turned(along, out, across);
  }
  Eigen::Vector3d size(double along, double out, double across) const {
    return turned(along, out, across).cwiseAbs();
  }
  int axis() const { return is_upright ? 2 : 0; }
};

Seat seat(const Front& front, const Handle& handle) {
  const double face = -front.thickness;
  const double x = 0.5 * (front.left + front.right);
  const double z = 0.5 * (front.bottom + front.top);
  if (front.hinged == 0) {
    const double up = std::min(0.2 * front.height(), 0.5 * front.height() - 0.025);
    return {{x, face, z + up}, false, std::min(handle.length, kMostOfFront * front.width())};
  }
  const double free = front.hinged < 0 ? front.right - kEdge : front.left + kEdge;
  return {{free, face, z}, true, std::min(handle.length, kMostOfFront * front.height())};
}

void add_bar(const Seat& seat, const Handle& handle, std::vector<DraftPart>& parts) {
  const double t = handle.thickness;
  const double post = handle.reach - t;
  parts.push_back(box_part(seat.size(seat.length, t, t), seat.at(0.0, handle.reach - 0.5 * t)));
  for (const double side : {-0.4, 0.4}) {
    parts.push_back(box_part(seat.size(t, post, t), seat.at(side * seat.length, 0.5 * post)));
  }
}

void add_bow(const Seat& seat, const Handle& handle, std::vector<DraftPart>& parts) {
  const double radius = 0.5 * handle.thickness;
  const double post = handle.reach - radius;
  parts.push_back(cylinder_part(radius, seat.length, seat.axis(), seat.at(0.0, post)));
  for (const double side : {-0.4, 0.4}) {
    parts.push_back(cylinder_part(0.8 * radius, post, 1, seat.at(side * seat.length, 0.5 * post)));
  }
}

void add_knob(const Seat& seat, const Handle& handle, std::vector<DraftPart>& parts) {
  const double head = 0.5 * handle.reach;
  parts.push_back(cylinder_part(0.25 * handle.thickness, head, 1, seat.at(0.0, 0.5 * head)));
  parts.push_back(cylinder_part(0.5 * handle.thickness, head, 1, seat.at(0.0, 1.5 * head)));
}

/// A strip along the upper edge of a drawer, or the free edge of a door.
void add_lip(const Front& front, const Handle& handle, std::vector<DraftPart>& parts) {
  constexpr double kShare = 0.9;  // of the edge
  const double t = handle.thickness;
  const double y = -front.thickness - 0.5 * handle.reach;
  const double x = 0.5 * (front.left + front.right);
  const double z = 0.5 * (front.bottom + front.top);
  if (front.hinged == 0) {
    parts.push_back(
        box_part({kShare * front.width(), handle.reach, t}, {x, y, front.top - 0.5 * t}));
    return;
  }
  const double free = front.hinged < 0 ? front.right - 0.5 * t : front.left + 0.5 * t;
  parts.push_back(box_part({t, handle.reach, kShare * front.height()}, {free, y, z}));
}

/// Four boxes around the hole, and a plate behind it.
void add_front_with_hole(const Front& front, const Seat& seat, std::vector<DraftPart>& parts) {
  const Eigen::Vector3d hole = seat.size(seat.length, 0.0, kRecessWidth);
  const double left = seat.centre.x() - 0.5 * hole.x();
  const double right = seat.centre.x() + 0.5 * hole.x();
  const double bottom = seat.centre.z() - 0.5 * hole.z();
  const double top = seat.centre.z() + 0.5 * hole.z();
  const auto add = [&](double x0, double x1, double z0, double z1, double depth) {
    parts.push_back(
        box_part({x1 - x0, depth, z1 - z0}, {0.5 * (x0 + x1), -0.5 * depth, 0.5 * (z0 + z1)}));
  };
  add(front.left, left, front.bottom, front.top, front.thickness);
  add(right, front.right, front.bottom, front.top, front.thickness);
  add(left, right, front.bottom, bottom, front.thickness);
  add(left, right, top, front.top, front.thickness);
  add(left, right, bottom, top, kPlate);
}

}  // namespace

Handle draw_handle(HandleKind kind, RandomDraws& random) {
  const auto draw = [&](Range length, Range thickness, Range reach) {
    return Handle{kind, length.draw(random), thickness.draw(random), reach.draw(random)};
  };
  switch (kind) {
    case HandleKind::bar:
      return draw({0.10, 0.20}, {0.010, 0.014}, {0.028, 0.042});
    case HandleKind::knob:
      return draw({0.0, 0.0}, {0.024, 0.036}, {0.022, 0.034});
    case HandleKind::lip:
      return draw({0.0, 0.0}, {0.005, 0.010}, {0.015, 0.028});
    case HandleKind::bow:
      return draw({0.14, 0.32}, {0.010, 0.016}, {0.026, 0.048});
    case HandleKind::cup:
      return draw({0.08, 0.11}, {0.035, 0.045}, {0.018, 0.028});
    case HandleKind::recess:
      return draw({0.09, 0.16}, {0.0, 0.0}, {0.0, 0.0});
  }
  return {};
}

std::vector<DraftPart> front_with_handle(const Front& front, const Handle& handle) {
  const Seat place = seat(front, handle);
  std::vector<DraftPart> parts;
  if (handle.kind == HandleKind::recess) {
    add_front_with_hole(front, place, parts);
    return parts;
  }
  parts.push_back(box_part({front.width(), front.thickness, front.height()},
                           {0.5 * (front.left + front.right), -0.5 * front.thickness,
                            0.5 * (front.bottom + front.top)}));
  switch (handle.kind) {
    case HandleKind::bar:
      add_bar(place, handle, parts);
      break;
    case HandleKind::bow:
      add_bow(place, handle, parts);
      break;
    case HandleKind::knob:
      add_knob(place, handle, parts);
      break;
    case HandleKind::lip:
      add_lip(front, handle, parts);
      break;
    case HandleKind::cup:
      parts.push_back(box_part(place.size(place.length, handle.reach, handle.thickness),
                               place.at(0.0, 0.5 * handle.reach)));
      break;
    case HandleKind::recess:
      break;
  }
  return parts;
}

}  // namespace lockbox::simulation

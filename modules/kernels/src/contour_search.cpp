// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contour_search.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contour_search.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr double kFarthest = 48.0;      // pixels that a contour is sought along its normal
constexpr double kSurelyInside = 0.75;  // of the way that it is sought
constexpr double kHorizon = 0.1;  // of the relative nearness: the surface is seen edge on there

using Tag = hn::CappedTag<double, kLanes>;
using Number = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE Number constant(const double value) {
  return hn::Set(Tag(), value);
}

HWY_INLINE Number square(const Number a) {
  return hn::Mul(a, a);
}

/// What a pixel shows of a contour: the surface that ends there, something behind it, something
/// before it (or nothing of the image), or nothing that is known.
struct Shown {
  Number behind;  // metres, where known
  Mask beyond;
  Mask nearer;
  Mask unknown;
};

/// Pixels along the normals of contours, numbered outwards; 0 is the one that a contour passes.
struct Walks {
  Number depth;         // of the contour, metres
  Number slope;         // of 1 / depth of the surface, relative, a pixel
  Number start[2];      // where the contour passes, pixels
  Number direction[2];  // unit vector in the image
  Number pixel_size;    // metres along the normal
  Number nearer;        // metres before the surface that are something else

  HWY_INLINE Number pixel_at(const Number k, const int axis) const {
    return hn::Floor(hn::MulAdd(k, direction[axis], hn::Add(start[axis], constant(0.5))));
  }

  HWY_INLINE Shown look(const ContourImage& image, const Number k, const Number beyond) const {
    const Tag tag;
    const hn::Rebind<std::int32_t, Tag> di;
    const hn::Rebind<float, Tag> df;
    const Number zero = hn::Zero(tag);
    const Number u = pixel_at(k, 0);
    const Number v = pixel_at(k, 1);
    const Mask inside = hn::And(hn::And(hn::Ge(u, zero), hn::Lt(u, constant(image.width))),
                                hn::And(hn::Ge(v, zero), hn::Lt(v, constant(image.height))));
    const Number index = hn::IfThenElseZero(inside, hn::MulAdd(v, constant(image.width), u));
    const Number measured =
        hn::PromoteTo(tag, hn::GatherIndex(df, image.depth, hn::DemoteTo(di, index)));
    const Number nearness = hn::Max(constant(kHorizon), hn::MulAdd(slope, k, constant(1.0)));
    const Number behind = hn::Sub(measured, hn::Div(depth, nearness));
    const Mask known = hn::And(inside, hn::Gt(measured, zero));
    return {behind, hn::And(known, hn::Gt(behind, beyond)),
            hn::Or(hn::Not(inside), hn::And(known, hn::Lt(behind, hn::Neg(nearer)))),
            hn::AndNot(known, inside)};
  }

  /// Returns the position of the centre of a pixel, metres outwards from the model's contour.
  HWY_INLINE Number position(const Number k) const {
    const Number u = hn::Sub(pixel_at(k, 0), start[0]);
    const Number v = hn::Sub(pixel_at(k, 1), start[1]);
    return hn::Mul(pixel_size, hn::MulAdd(u, direction[0], hn::Mul(v, direction[1])));
  }
};

struct Found {
  Number k;
  Number behind;
  Mask is_wanted;  // what pixel k shows
  Mask at_end;     // the walk ended without it, but nothing came in between
};

/// Walks by `step` from pixel k to `last` until one shows the surface, or what lies beyond it.
template <bool WantsBeyond>
HWY_INLINE Found seek(const Walks& walks, const ContourImage& image, Number k, const Number last,
                      const double step, const Number beyond, const Mask which) {
  const Tag tag;
  const Mask none = hn::Ne(last, last);
  Found found{k, hn::Zero(tag), none, none};
  Mask walks_on = which;
  Mask was_unknown = none;
  while (!hn::AllFalse(tag, walks_on)) {
    const Shown shown = walks.look(image, k, beyond);
    const Mask surface = hn::Not(hn::Or(shown.nearer, hn::Or(shown.beyond, shown.unknown)));
    const Mask wanted = hn::And(walks_on, WantsBeyond ? shown.beyond : surface);
    found.k = hn::IfThenElse(wanted, k, found.k);
    found.behind = hn::IfThenElse(wanted, shown.behind, found.behind);
    found.is_wanted = hn::Or(found.is_wanted, wanted);
    walks_on = hn::AndNot(wanted, walks_on);
    walks_on = hn::AndNot(hn::Or(shown.nearer, hn::And(shown.unknown, was_unknown)), walks_on);
    was_unknown = shown.unknown;
    const Mask ends = hn::And(walks_on, hn::Eq(k, last));
    found.at_end = hn::Or(found.at_end, ends);
    walks_on = hn::AndNot(ends, walks_on);
    k = hn::Add(k, constant(step));
  }
  return found;
}

/// rotation * v + translation.
HWY_INLINE void move(const ContourPose& pose, const bool translates, const Number v[3],
                     Number result[3]) {
  for (int row = 0; row < 3; ++row) {
    const double* const r = pose.rotation + static_cast<std::ptrdiff_t>(3) * row;
    const Number offset = constant(translates ? pose.translation[row] : 0.0);
    result[row] =
        hn::MulAdd(constant(r[0]), v[0],
                   hn::MulAdd(constant(r[1]), v[1], hn::MulAdd(constant(r[2]), v[2], offset)));
  }
}

/// The image of the normals n at points p, camera's frame.
HWY_INLINE void aim(const ContourImage& image, const Number p[3], const Number n[3], Walks& walks) {
  const Number per_depth = hn::Div(constant(1.0), p[2]);
  Number change[2];  // pixels a metre
  for (int axis = 0; axis < 2; ++axis) {
    const Number ray = hn::Mul(p[axis], per_depth);
    const Number focal_length = constant(image.focal_length[axis]);
    walks.start[axis] = hn::MulAdd(focal_length, ray, constant(image.centre[axis]));
    change[axis] = hn::Mul(hn::Mul(focal_length, per_depth), hn::NegMulAdd(n[2], ray, n[axis]));
  }
  walks.pixel_size =
      hn::Div(constant(1.0), hn::Sqrt(hn::MulAdd(change[0], change[0], square(change[1]))));
  for (int axis = 0; axis < 2; ++axis) {
    walks.direction[axis] = hn::Mul(change[axis], walks.pixel_size);
  }
  walks.depth = p[2];
}

/// What contours at points p, camera's frame, are to the search.
struct Limits {
  Number lateral2;  // variance across the ray, m^2
  Number zone;      // metres along the ray that are no step
  Number reach;     // metres along the normal that are searched
  Number last;      // the same in whole pixels
};

HWY_INLINE Limits limits_of(const ContourImage& image, const ContourSearch& search,
                            const Number steepness, const Walks& walks) {
  const Number z = walks.depth;
  const Number lateral2 =
      square(hn::Mul(constant(search.lateral_pixels / image.focal_length[0]), z));
  const Number sigma =
      hn::MulAdd(constant(search.depth_quadratic), square(z),
                 hn::MulAdd(constant(search.depth_linear), z, constant(search.depth_floor)));
  const Number blur = hn::Mul(hn::Mul(constant(search.lateral_pixels), steepness), z);
  const Number reach = hn::Mul(
      constant(search.gate),
      hn::Sqrt(hn::Add(lateral2, constant(search.annealing_sigma * search.annealing_sigma))));
  return {lateral2,
          hn::Mul(constant(search.tolerance), hn::Sqrt(hn::MulAdd(sigma, sigma, square(blur)))),
          reach, hn::Ceil(hn::Min(hn::Div(reach, walks.pixel_size), constant(kFarthest)))};
}

/// Stores where the contour passes, between the last pixel of the surface and the next known one,
/// which shows what lies beyond.
HWY_INLINE void store(const Walks& walks, const ContourImage& image, const Limits& limits,
                      const Found& surface, double* offset, double* variance) {
  const Tag tag;
  const Number next = hn::Add(surface.k, constant(1.0));
  const Mask is_gap = walks.look(image, next, limits.zone).unknown;
  const Number from = walks.position(surface.k);
  const Number to = walks.position(hn::IfThenElse(is_gap, hn::Add(next, constant(1.0)), next));
  const Number gap = hn::Max(hn::Zero(tag), hn::Sub(hn::Sub(to, from), walks.pixel_size));
  const Number passes = hn::Mul(constant(0.5), hn::Add(from, to));
  hn::StoreU(
      hn::IfThenElse(surface.is_wanted, passes, hn::Mul(constant(-kSurelyInside), limits.reach)),
      tag, offset);
  const Number whole_variance = hn::MulAdd(hn::IfThenElseZero(surface.is_wanted, square(gap)),
                                           constant(1.0 / 12.0), limits.lateral2);
  hn::StoreU(hn::IfThenElseZero(hn::Or(surface.is_wanted, surface.at_end), whole_variance), tag,
             variance);
}

void search_contour(const ContourSpan& points, std::size_t i, const ContourPose& camera_from_body,
                    const ContourImage& image, const ContourSearch& search,
                    const ContourCorrespondences& correspondences) {
  const Tag tag;
  const auto load = [i](const double* values) HWY_ATTR { return hn::LoadU(Tag(), values + i); };
  const Number p_body[3] = {load(points.p[0]), load(points.p[1]), load(points.p[2])};
  const Number n_body[3] = {load(points.normal[0]), load(points.normal[1]), load(points.normal[2])};
  Number p[3];
  Number n[3];
  move(camera_from_body, true, p_body, p);
  move(camera_from_body, false, n_body, n);
  Walks walks;
  aim(image, p, n, walks);
  walks.slope = hn::Mul(load(points.slope), walks.pixel_size);
  const Limits limits = limits_of(image, search, load(points.steepness), walks);
  walks.nearer = hn::Add(limits.zone, load(points.rise));
  const Number zero = hn::Zero(tag);
  const Mask is_in_front = hn::And(hn::Gt(p[2], zero), hn::Ge(limits.last, zero));
  const Found beyond = seek<true>(walks, image, zero, limits.last, 1.0, limits.zone, is_in_front);
  // Halfway to what is seen there, lest noise speaks for one side only.
  const Number halfway = hn::Min(limits.zone, hn::Mul(constant(0.5), beyond.behind));
  const Found surface =
      seek<false>(walks, image, beyond.k, hn::Neg(limits.last), -1.0, halfway, beyond.is_wanted);
  store(walks, image, limits, surface, correspondences.offset + i, correspondences.variance + i);
}

void search_all_contours(const ContourSpan& points, const ContourPose& camera_from_body,
                         const ContourImage& image, const ContourSearch& search,
                         const ContourCorrespondences& correspondences) {
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(Tag())) {
    search_contour(points, i, camera_from_body, image, search, correspondences);
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(search_all_contours);

void search_contours(const ContourSpan& points, const ContourPose& camera_from_body,
                     const ContourImage& image, const ContourSearch& search,
                     const ContourCorrespondences& correspondences) {
  HWY_DYNAMIC_DISPATCH(search_all_contours)
  (points, camera_from_body, image, search, correspondences);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE

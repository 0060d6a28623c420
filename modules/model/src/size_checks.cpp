// SPDX-License-Identifier: BSD-3-Clause
#include "size_checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "length_units.hpp"
#include "lockbox/core/readable_text.hpp"
#include "size_advice.hpp"

namespace lockbox {
namespace {

using Named = std::vector<std::pair<std::string, std::string>>;

/// Warns of the first, and says how many are like it.
void warn_of_first(const Named& found, const Complaint& warn) {
  if (found.empty()) return;
  const std::size_t more = found.size() - 1;
  const std::string tail = more == 0 ? "" : " (and " + std::to_string(more) + " more like it)";
  warn(found.front().first, found.front().second + tail);
}

std::vector<double> other_lengths(const KinematicTree& tree) {
  std::vector<double> lengths;
  for (const Joint& joint : tree.joints) {
    lengths.push_back(joint.T_parent_joint.translation().norm());
    if (joint.type != JointType::prismatic || joint.is_mimic) continue;
    lengths.push_back(std::max(std::abs(joint.lower), std::abs(joint.upper)));
  }
  return lengths;
}

/// The largest of the lengths that a depth camera would see.
double largest_seen(const std::vector<double>& lengths) {
  double largest = 0.0;
  for (const double length : lengths) {
    if (length <= kLargestSeen) largest = std::max(largest, length);
  }
  return largest;
}

/// Returns the largest size of all other visuals and of the joints, as far as depth cameras see
/// them.
double largest_beside(const std::vector<VisualExtent>& visuals, const VisualExtent& visual,
                      const std::vector<double>& others) {
  double largest = largest_seen(others);
  for (const VisualExtent& other : visuals) {
    if (&other != &visual && other.size() <= kLargestSeen)
      largest = std::max(largest, other.size());
  }
  return largest;
}

/// Beyond what is seen; or, of what would be seen in millimetres, out of proportion.
bool is_too_large(double size, double largest_of_others) {
  if (size > kLargestSeen) return true;
  return size > 1000.0 * kSmallestSeen && largest_of_others > 0.0 &&
         size > kOutOfProportion * largest_of_others;
}

void check_large(const std::vector<VisualExtent>& visuals, const std::vector<double>& others,
                 const SizeContext& context, const SizeComplaints& complaints) {
  Named found;
  for (const VisualExtent& visual : visuals) {
    if (!is_too_large(visual.size(), largest_beside(visuals, visual, others))) continue;
    const std::string advice = advice_on_large(visual, context);
    if (visual.size() > kLargestLink) complaints.refuse_link(visual.link, advice);
    found.emplace_back(visual.link, advice);
  }
  warn_of_first(found, complaints.warn_of_link);
}

/// A screw upon a door may be small: bodies count, by their largest visual.
void check_small(const std::vector<VisualExtent>& visuals, const SizeContext& context,
                 const SizeComplaints& complaints) {
  std::map<int, const VisualExtent*> largest;
  for (const VisualExtent& visual : visuals) {
    const VisualExtent*& so_far = largest[visual.body];
    if (so_far == nullptr || visual.size() > so_far->size()) so_far = &visual;
  }
  Named found;
  for (const auto& [body, visual] : largest) {
    if (visual->size() >= kSmallestSeen) continue;
    found.emplace_back(visual->link, advice_on_small(*visual, context));
  }
  warn_of_first(found, complaints.warn_of_link);
}

/// Metres beyond which a place is hardly in metres, in a model whose largest visual is that large.
double farthest_place(double largest_visual) {
  constexpr double kAnywhere = 2.0;  // metres; things stand about in a room
  return std::max(kAnywhere, kOutOfProportion * largest_visual);
}

std::string place_advice(const std::string& what, double distance, double usual) {
  const auto unit = probable_unit(distance, usual);
  return what + " " + readable_length(distance) +
         " away, far beyond the sizes of the model; origins are in metres" +
         (unit ? std::string(": if ") + unit->name + " are meant, write " +
                     readable_number(unit->metres * distance) + " for " + readable_number(distance)
               : "");
}

/// There is no URDF in which an origin could be written.
std::string advice_on_bare_mesh(const VisualExtent& visual) {
  return "the mesh lies " + readable_length(visual.distance()) +
         " away from its origin, far beyond its size; poses are those of the origin: move the "
         "vertices there, unless that is meant";
}

/// Whether all visuals of a body together are larger than any link may be.
bool is_beyond_all_links(const std::vector<VisualExtent>& visuals, int body) {
  Eigen::AlignedBox3d box;
  for (const VisualExtent& visual : visuals) {
    if (visual.body == body) box.extend(visual.box);
  }
  return box.sizes().maxCoeff() > kLargestLink;
}

void check_places(const std::vector<VisualExtent>& visuals, const KinematicTree& tree,
                  const SizeContext& context, const SizeComplaints& complaints) {
  std::vector<double> sizes;
  sizes.reserve(visuals.size());
  for (const VisualExtent& visual : visuals) sizes.push_back(visual.size());
  const double farthest = farthest_place(largest_seen(sizes));
  Named links;
  for (const VisualExtent& visual : visuals) {
    if (visual.distance() <= farthest) continue;
    const std::string advice =
        context.is_bare ? advice_on_bare_mesh(visual)
                        : place_advice("its <origin>, or that of a fixed joint, puts its geometry",
                                       visual.distance(), context.usual);
    const bool is_apart = is_beyond_all_links(visuals, visual.body);
    if (is_apart) complaints.refuse_link(visual.link, advice);
    links.emplace_back(visual.link, advice);
  }
  warn_of_first(links, complaints.warn_of_link);
  Named joints;
  for (const Joint& joint : tree.joints) {
    const double distance = joint.T_parent_joint.translation().norm();
    const Body& parent = tree.bodies[static_cast<std::size_t>(joint.parent_body)];
    if (parent.visuals.empty() || distance <= farthest) continue;  // a frame may be anywhere
    joints.emplace_back(joint.name, place_advice("its <origin> puts it", distance, context.usual));
  }
  warn_of_first(joints, complaints.warn_of_joint);
}

}  // namespace

void check_sizes(const std::vector<VisualExtent>& visuals, const KinematicTree& tree,
                 double mesh_scale, bool is_bare, const SizeComplaints& complaints) {
  const std::vector<double> others = other_lengths(tree);
  std::vector<double> lengths = others;
  for (const VisualExtent& visual : visuals) lengths.push_back(visual.size());
  const SizeContext context{usual_length(std::move(lengths)), mesh_scale, is_bare};
  check_large(visuals, others, context, complaints);
  check_small(visuals, context, complaints);
  check_places(visuals, tree, context, complaints);
}

}  // namespace lockbox

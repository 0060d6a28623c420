// SPDX-License-Identifier: BSD-3-Clause
#include "household_kinds.hpp"
#include "lockbox/simulation/object_block.hpp"

namespace lockbox {
namespace simulation {
namespace {

/// Left and right walls, of the depth and height given, from z on.
void add_sides(const Eigen::Vector3d& size, double wall, std::vector<DraftPart>& parts) {
  for (const double side : {-0.5, 0.5}) {
    parts.push_back(
        box_part({wall, size.y(), size.z()}, {side * (size.x() - wall), 0.0, 0.5 * size.z()}));
  }
}

}  // namespace

std::vector<DraftPart> case_open_to_front(const Eigen::Vector3d& size, double wall) {
  std::vector<DraftPart> parts;
  add_sides(size, wall, parts);
  for (const double z : {0.5 * wall, size.z() - 0.5 * wall}) {
    parts.push_back(box_part({size.x(), size.y(), wall}, {0.0, 0.0, z}));
  }
  parts.push_back(
      box_part({size.x(), wall, size.z()}, {0.0, 0.5 * (size.y() - wall), 0.5 * size.z()}));
  return parts;
}

std::vector<DraftPart> case_open_to_top(const Eigen::Vector3d& size, double wall) {
  std::vector<DraftPart> parts;
  add_sides(size, wall, parts);
  for (const double side : {-0.5, 0.5}) {
    parts.push_back(
        box_part({size.x(), wall, size.z()}, {0.0, side * (size.y() - wall), 0.5 * size.z()}));
  }
  parts.push_back(box_part({size.x(), size.y(), wall}, {0.0, 0.0, 0.5 * wall}));
  return parts;
}

}  // namespace simulation

ObjectDraft draw_household(const ObjectBlock& block, std::uint64_t number) {
  const auto kinds =
      block.is_for_tuning() ? simulation::tuning_household() : simulation::test_household();
  RandomDraws random = block.draws(ObjectBlock::Purpose::shape, number);
  return kinds[number % kinds.size()](random);
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "lockbox/simulation/object_block.hpp"
#include "mechanisms.hpp"

namespace lockbox {
namespace {

using simulation::Mechanism;
using simulation::MechanismKind;
using simulation::Range;

constexpr double kMargin = 0.03;  // of the board, around its cells, metres
constexpr double kTwins = 0.35;   // chance that a mechanism is one that the board has already

/// Metres.
struct BoardStyle {
  Range edge;
  Range cell;
  Range thickness;
  double frame;        ///< chance of a frame around the board
  double round_grips;  ///< chance of round ones
  int most_mechanisms;
};

constexpr BoardStyle kTuningBoards{{0.4, 0.85}, {0.19, 0.26}, {0.012, 0.025}, 0.3, 1.0, 5};
constexpr BoardStyle kTestBoards{{0.45, 1.0}, {0.17, 0.30}, {0.010, 0.035}, 0.4, 0.0, 7};

void add_board(const BoardStyle& style, const Eigen::Vector2d& size, RandomDraws& random,
               ObjectDraft& draft) {
  const double thickness = style.thickness.draw(random);
  DraftLink& board = draft.links.emplace_back(DraftLink{"board", {}});
  board.parts.push_back(box_part({size.x(), size.y(), thickness}, {0.0, 0.0, -0.5 * thickness}));
  if (!random.chance(style.frame)) return;
  const double width = random.uniform(0.015, 0.5 * kMargin + 0.008);
  const double height = random.uniform(0.015, 0.04);
  for (const double side : {-0.5, 0.5}) {
    board.parts.push_back(
        box_part({width, size.y(), height}, {side * (size.x() - width), 0.0, 0.5 * height}));
    board.parts.push_back(box_part({size.x() - 2.0 * width, width, height},
                                   {0.0, side * (size.y() - width), 0.5 * height}));
  }
}

void add_mechanism(const Mechanism& mechanism, const Eigen::Vector3d& place, ObjectDraft& draft) {
  constexpr std::array kNames = {"slider", "bolt", "disk", "door"};
  const std::string name = std::string(kNames[static_cast<std::size_t>(mechanism.kind)]) + "_" +
                           std::to_string(draft.joints.size() + 1);
  for (DraftPart part : mechanism.fixed) {
    part.centre += place;
    draft.links.front().parts.push_back(part);
  }
  draft.links.push_back({name, mechanism.moving});
  DraftJoint joint = mechanism.joint;
  joint.name = joint.child = name;
  joint.origin += place;
  draft.joints.push_back(joint);
}

/// The middles of the cells, in random order.
std::vector<Eigen::Vector3d> draw_places(const Eigen::Vector2d& size, double cell,
                                         RandomDraws& random) {
  const Eigen::Vector2i count = ((size.array() - 2.0 * kMargin) / cell).cast<int>().max(1);
  const Eigen::Vector2d pitch = (size.array() - 2.0 * kMargin) / count.cast<double>().array();
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < count.x(); ++i) {
    for (int j = 0; j < count.y(); ++j) {
      const Eigen::Array2d middle =
          Eigen::Array2d(i + 0.5, j + 0.5) * pitch.array() - 0.5 * (size.array() - 2.0 * kMargin);
      places.emplace_back(middle.x(), middle.y(), 0.0);
    }
  }
  for (std::size_t i = places.size(); i > 1; --i) {
    const int other = simulation::draw_number(random, 0, static_cast<int>(i) - 1);
    std::swap(places[i - 1], places[static_cast<std::size_t>(other)]);
  }
  return places;
}

}  // namespace

ObjectDraft draw_board(const ObjectBlock& block, std::uint64_t number) {
  const BoardStyle& style = block.is_for_tuning() ? kTuningBoards : kTestBoards;
  RandomDraws random = block.draws(ObjectBlock::Purpose::shape, number);
  ObjectDraft draft;
  draft.name = "board_" + std::to_string(number);
  const double height = style.edge.draw(random);
  const Eigen::Vector2d size(style.edge.draw(random), height);
  const double cell = std::min(style.cell.draw(random), size.minCoeff() - 2.0 * kMargin);
  const bool has_round_grips = random.chance(style.round_grips);
  add_board(style, size, random, draft);
  const auto places = draw_places(size, cell, random);
  const int most = std::min(style.most_mechanisms, static_cast<int>(places.size()));
  const int count = simulation::draw_number(random, std::min(2, most), most);
  std::vector<Mechanism> drawn;
  for (int i = 0; i < count; ++i) {
    if (!drawn.empty() && random.chance(kTwins)) {
      const int twin = simulation::draw_number(random, 0, i - 1);
      drawn.push_back(drawn[static_cast<std::size_t>(twin)]);
    } else {
      const auto kind = static_cast<MechanismKind>(simulation::draw_number(random, 0, 3));
      drawn.push_back(draw_mechanism(kind, cell, has_round_grips, random));
    }
    add_mechanism(drawn.back(), places[static_cast<std::size_t>(i)], draft);
  }
  return draft;
}

}  // namespace lockbox

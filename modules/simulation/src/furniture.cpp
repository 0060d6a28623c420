// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <numeric>

#include "handles.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/simulation/object_block.hpp"

namespace lockbox {
namespace {

using simulation::Front;
using simulation::Handle;
using simulation::HandleKind;
using simulation::Range;

constexpr int kMostCells = 7;
constexpr int kMostColumns = 3;
constexpr int kMostRows = 4;
constexpr double kLeastColumn = 0.2;  // width, metres
constexpr double kBackPanel = 0.008;  // thickness, metres
constexpr double kDoorFrom = 0.28;    // height of a cell, metres: lower ones are drawers
constexpr double kDoorOnly = 0.55;    // higher ones are doors

/// Metres.
struct FurnitureStyle {
  Range width;
  Range height;
  Range depth;
  Range panel;
  Range front;
  Range gap;
  Range overhang;
  Range plinth;
  std::array<HandleKind, 3> handles;
};

constexpr FurnitureStyle kTuningFurniture{
    {0.4, 0.9},     {0.45, 0.85},   {0.35, 0.55},
    {0.016, 0.019}, {0.016, 0.020}, {0.002, 0.003},
    {0.008, 0.020}, {0.06, 0.10},   {HandleKind::bar, HandleKind::knob, HandleKind::lip}};
constexpr FurnitureStyle kTestFurniture{
    {0.45, 1.2},    {0.4, 1.0},     {0.3, 0.6},
    {0.014, 0.022}, {0.017, 0.024}, {0.002, 0.004},
    {0.010, 0.035}, {0.04, 0.14},   {HandleKind::bow, HandleKind::cup, HandleKind::recess}};

class FurnitureDraft {
 public:
  FurnitureDraft(const FurnitureStyle& style, RandomDraws& random)
      : style_(style),
        random_(random),
        width_(style.width.draw(random)),
        height_(style.height.draw(random)),
        depth_(style.depth.draw(random)),
        panel_(style.panel.draw(random)),
        front_(style.front.draw(random)),
        gap_(style.gap.draw(random)),
        handle_(draw_handle(
            style.handles[static_cast<std::size_t>(simulation::draw_number(random, 0, 2))],
            random)) {
    draft_.links.push_back({"carcass", {}});
    add_carcass();
    if (random_.chance(0.5)) add_plinth();
    if (random_.chance(0.5)) add_top();
    add_columns();
  }

  const ObjectDraft& draft() const { return draft_; }

 private:
  void add_to_carcass(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
    draft_.links.front().parts.push_back(box_part(size, centre));
  }
  void add_carcass();
  void add_plinth();
  void add_top();
  void add_columns();
  void add_cells(int column, int columns, int rows);
  void add_door(Front front);
  void add_drawer(const Front& front, double left, double right);
  std::vector<double> draw_row_shares(int rows);

  const FurnitureStyle& style_;
  RandomDraws& random_;
  double width_;
  double height_;
  double depth_;
  double panel_;
  double front_;
  double gap_;
  Handle handle_;
  ObjectDraft draft_;
};

void FurnitureDraft::add_carcass() {
  const double y = 0.5 * depth_;
  for (const double side : {-1.0, 1.0}) {
    add_to_carcass({panel_, depth_, height_}, {side * 0.5 * (width_ - panel_), y, 0.5 * height_});
  }
  for (const double z : {0.5 * panel_, height_ - 0.5 * panel_}) {
    add_to_carcass({width_ - 2.0 * panel_, depth_, panel_}, {0.0, y, z});
  }
  add_to_carcass({width_ - 2.0 * panel_, kBackPanel, height_ - 2.0 * panel_},
                 {0.0, depth_ - 0.5 * kBackPanel, 0.5 * height_});
}

void FurnitureDraft::add_plinth() {
  const double height = style_.plinth.draw(random_);
  const double behind = random_.uniform(0.03, 0.06);
  add_to_carcass({width_ - 0.02, depth_ - behind, height},
                 {0.0, 0.5 * (depth_ + behind), -0.5 * height});
}

/// It reaches over the fronts.
void FurnitureDraft::add_top() {
  const double overhang = style_.overhang.draw(random_);
  const double thickness = random_.uniform(0.018, 0.04);
  const double before = front_ + overhang;
  add_to_carcass({width_ + 2.0 * overhang, depth_ + before, thickness},
                 {0.0, 0.5 * (depth_ - before), height_ + 0.5 * thickness});
}

void FurnitureDraft::add_columns() {
  const int cells = simulation::draw_number(random_, 1, kMostCells);
  const int fewest = (cells + kMostRows - 1) / kMostRows;
  const int most = std::min({kMostColumns, cells, static_cast<int>(width_ / kLeastColumn)});
  const int columns = simulation::draw_number(random_, fewest, std::max(fewest, most));
  for (int column = 0; column < columns; ++column) {
    const int rows = cells / columns + (column < cells % columns ? 1 : 0);
    if (column > 0) {
      const double x = -0.5 * width_ + column * width_ / columns;
      add_to_carcass({panel_, depth_ - kBackPanel, height_ - 2.0 * panel_},
                     {x, 0.5 * (depth_ - kBackPanel), 0.5 * height_});
    }
    add_cells(column, columns, rows);
  }
}

std::vector<double> FurnitureDraft::draw_row_shares(int rows) {
  std::vector<double> shares(static_cast<std::size_t>(rows), 1.0);
  if (random_.chance(0.5)) {
    for (double& share : shares) share = random_.uniform(0.8, 1.5);
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

void FurnitureDraft::add_cells(int column, int columns, int rows) {
  const double pitch = width_ / columns;
  const double left = -0.5 * width_ + column * pitch;
  const double inner_left = left + (column == 0 ? panel_ : 0.5 * panel_);
  const double inner_right = left + pitch - (column + 1 == columns ? panel_ : 0.5 * panel_);
  double bottom = 0.0;
  for (const double share : draw_row_shares(rows)) {
    const double height = share * height_;
    const Front front{left + 0.5 * gap_, left + pitch - 0.5 * gap_, bottom + 0.5 * gap_,
                      bottom + height - 0.5 * gap_, front_};
    const bool is_door = height > kDoorOnly || (height > kDoorFrom && random_.chance(0.6));
    if (is_door) {
      add_door(front);
    } else {
      add_drawer(front, inner_left, inner_right);
    }
    bottom += height;
  }
}

/// Hinged at the edge of its face, so that no part of it turns into what is beside or behind it.
void FurnitureDraft::add_door(Front front) {
  front.hinged = random_.chance(0.5) ? -1 : 1;
  const std::string name = "door_" + std::to_string(draft_.joints.size() + 1);
  const Eigen::Vector3d hinge(front.hinged < 0 ? front.left : front.right, -front.thickness, 0.0);
  DraftLink link{name, front_with_handle(front, handle_)};
  for (DraftPart& part : link.parts) part.centre -= hinge;
  draft_.links.push_back(std::move(link));
  draft_.joints.push_back({name, JointType::revolute, name, hinge,
                           Eigen::Vector3d(0.0, 0.0, front.hinged), 0.0,
                           random_.uniform(95.0, 125.0) * kRadians});
}

/// left, right: of the room inside.
void FurnitureDraft::add_drawer(const Front& front, double left, double right) {
  constexpr double kRunner = 0.013;   // room for a runner on either side, metres
  constexpr double kBoard = 0.012;    // of the box, metres
  constexpr double kLeastBox = 0.03;  // height, metres
  const std::string name = "drawer_" + std::to_string(draft_.joints.size() + 1);
  DraftLink link{name, front_with_handle(front, handle_)};
  const double x0 = left + kRunner;
  const double x1 = right - kRunner;
  const double bottom = front.bottom + panel_ + 0.01;
  const double top = std::min(bottom + 0.65 * front.height(), front.top - panel_ - 0.01);
  const double length = 0.9 * (depth_ - kBackPanel);
  if (top - bottom > kLeastBox) {
    const double z = 0.5 * (bottom + top);
    for (const double x : {x0 + 0.5 * kBoard, x1 - 0.5 * kBoard}) {
      link.parts.push_back(box_part({kBoard, length, top - bottom}, {x, 0.5 * length, z}));
    }
    const double x = 0.5 * (x0 + x1);
    const double inner = x1 - x0 - 2.0 * kBoard;
    link.parts.push_back(box_part({inner, kBoard, top - bottom}, {x, length - 0.5 * kBoard, z}));
    link.parts.push_back(box_part({inner, length - kBoard, kBoard},
                                  {x, 0.5 * (length - kBoard), bottom + 0.5 * kBoard}));
  }
  draft_.links.push_back(std::move(link));
  draft_.joints.push_back({name, JointType::prismatic, name, Eigen::Vector3d::Zero(),
                           -Eigen::Vector3d::UnitY(), 0.0, random_.uniform(0.6, 0.85) * depth_});
}

}  // namespace

ObjectDraft draw_furniture(const ObjectBlock& block, std::uint64_t number) {
  RandomDraws random = block.draws(ObjectBlock::Purpose::shape, number);
  ObjectDraft draft =
      FurnitureDraft(block.is_for_tuning() ? kTuningFurniture : kTestFurniture, random).draft();
  draft.name = "furniture_" + std::to_string(number);
  return draft;
}

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
// Rooms in which the object is not: whatever a tracker finds there is a false alarm.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

/// What stands where the object would.
enum class AbsentKind {
  furniture,     ///< walls, a floor, tables, shelves, cupboards, people
  boxes,         ///< a box of about the object's size, among others
  other_model,   ///< another articulated object
  missing_part,  ///< near miss: the object itself without one of its parts
  larger         ///< near miss: the object itself, 10 to 20 % larger
};

/// The word for rows and summaries.
std::string to_string(AbsentKind kind);

/// All kinds, those that are no near misses first.
const std::vector<AbsentKind>& absent_kinds();

/// Whether a tracker may be excused for taking it for the object.
bool is_near_miss(AbsentKind kind);

struct AbsentRoom {
  AbsentKind kind = AbsentKind::furniture;
  std::string content;     ///< what stands there, in a word without commas
  KinematicTree tree;      ///< what stands there, an empty mesh for furniture
  Scene scene;             ///< all else
  std::vector<State> run;  ///< of `tree`: joints rest, the camera is held in a hand
};

/// Draws such rooms. What is referred to must outlive it.
class AbsentRooms {
 public:
  /// others: objects that are not the model, nor contain it; may be none.
  AbsentRooms(const ArticulatedModel& model, std::vector<const ArticulatedModel*> others,
              const PinholeCamera& camera, std::uint64_t seed, const Executor& executor);

  /// The room with that number: furniture, boxes and another model in turns. It follows from the
  /// seed, the number and the model alone. No box in it has two edges that are within 15 % of two
  /// of the model's. frames: 30 a second, at least one.
  AbsentRoom room(std::uint64_t number, int frames) const;

  /// Draws a room likewise, with a near miss: it is larger, and without a part if the model has one
  /// that can be missing.
  AbsentRoom near_miss(std::uint64_t number, int frames) const;

  /// What kinds those are.
  AbsentKind kind_of_room(std::uint64_t number) const;
  AbsentKind kind_of_near_miss(std::uint64_t number) const;

 private:
  AbsentRoom furnished(std::uint64_t number) const;
  AbsentRoom with_box(std::uint64_t number) const;
  AbsentRoom with_other_model(std::uint64_t number) const;
  void surround(AbsentRoom& room, const ArticulatedModel& model, std::uint64_t number) const;
  bool has_lookalike(const Scene& scene) const;

  const ArticulatedModel& model_;
  std::vector<const ArticulatedModel*> others_;
  PinholeCamera camera_;
  std::uint64_t seed_;
  Executor executor_;
  std::vector<std::string> parts_;      ///< that the model can lack; a handle has no name
  std::vector<Eigen::Vector3d> sizes_;  ///< of the model at rest, and of its base alone
};

/// Whether boxes of these edge lengths differ, however they are turned: by at least that share of
/// the second one's in at least two of the three.
bool differs(const Eigen::Vector3d& size, const Eigen::Vector3d& other, double share);

}  // namespace lockbox

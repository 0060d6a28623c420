// SPDX-License-Identifier: BSD-3-Clause
// Blocks of random objects: whoever tunes draws from one, reports draw from others.
#pragma once

#include <cstdint>
#include <string>

#include "lockbox/simulation/object_draft.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox {

/// Objects and views of a block follow from its name and their number alone. `tune` and the blocks
/// `test:<n>` differ in proportions, handles and sensors, too.
class ObjectBlock {
 public:
  /// `tune`, or `test:` and a whole number. Throws InputError.
  explicit ObjectBlock(const std::string& name);

  bool is_for_tuning() const { return is_for_tuning_; }
  const std::string& name() const { return name_; }

  /// What is drawn of an object; one for each purpose, so that no draw shifts another's.
  enum class Purpose : std::uint64_t { shape = 1, joints, view, sensor };
  RandomDraws draws(Purpose purpose, std::uint64_t number) const;

 private:
  std::string name_;
  bool is_for_tuning_ = true;
  std::uint64_t block_ = 0;
};

/// A piece of furniture with one to seven drawers and doors in a grid, all closed at rest: x along
/// its front, y to its back, z up; the front of the carcass is the plane y = 0.
ObjectDraft draw_furniture(const ObjectBlock& block, std::uint64_t number);

/// A puzzle board of 0.4 to 1 m with sliders, bolts, disks and doors, equal twins among them: x to
/// the right, y up, z out of its front, which is the plane z = 0.
ObjectDraft draw_board(const ObjectBlock& block, std::uint64_t number);

/// A thing of a household or a workshop that folds, opens, turns or slides, 0.1 to 0.6 m: z is up
/// where it stands, its foot is at z = 0. Kinds by turns, their proportions drawn; no kind of the
/// tuning block is one of a test block.
ObjectDraft draw_household(const ObjectBlock& block, std::uint64_t number);

}  // namespace lockbox

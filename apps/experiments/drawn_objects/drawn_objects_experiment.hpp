// SPDX-License-Identifier: BSD-3-Clause
// What experiments share whose objects are drawn from a block of random ones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/shard.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/simulation/object_block.hpp"

namespace lockbox::app {

/// Runs object after object of a block, and goes on where an earlier run has ended.
class DrawnObjectsExperiment : public Experiment {
 public:
  explicit DrawnObjectsExperiment(std::uint64_t pieces) : pieces_(pieces) {}

  bool continues() const override { return true; }
  void add_options(CLI::App& options) override;
  bool run(const ExperimentSettings& settings) override;

 protected:
  virtual std::string name() const = 0;
  /// Returns the columns of a row; the first is `piece`.
  virtual std::vector<std::string> columns() const = 0;
  /// Returns what comes after the block in the files' names: what else the rows depend on.
  virtual std::string variant(const ExperimentSettings& settings) const = 0;
  /// Runs one, with a folder of its own, and adds its rows. Returns what is wrong; empty: nothing.
  virtual std::string run_piece(const ObjectBlock& block, std::uint64_t piece,
                                const std::filesystem::path& folder,
                                const ExperimentSettings& settings, Table& table) const = 0;
  /// Prints and draws what is in the files with rows of this stem.
  virtual void report(const std::filesystem::path& stem) const = 0;

  const std::string& block() const { return block_; }

 private:
  /// Has none.
  bool run_model(const ArticulatedModel& /*model*/,
                 const ExperimentSettings& /*settings*/) override {
    return true;
  }

  std::string stem_name(const ExperimentSettings& settings) const;

  std::string block_ = "tune";
  std::uint64_t pieces_;
  Shard shard_;
};

}  // namespace lockbox::app

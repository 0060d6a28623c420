// SPDX-License-Identifier: BSD-3-Clause
#include "drawn_objects_experiment.hpp"

#include <algorithm>
#include <set>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox::app {

void DrawnObjectsExperiment::add_options(CLI::App& options) {
  options.add_option("--block", block_,
                     "tune, or test:<n>: which objects are drawn; a block that a change has looked "
                     "at is none for reports any more");
  options.add_option("--pieces", pieces_, "Of the block")->check(positive());
  shard_.add_to(options);
}

std::string DrawnObjectsExperiment::stem_name(const ExperimentSettings& settings) const {
  std::string block = block_;
  std::replace(block.begin(), block.end(), ':', '-');
  return name() + "_" + block + "_" + variant(settings) + "seed" + std::to_string(settings.seed);
}

bool DrawnObjectsExperiment::run(const ExperimentSettings& settings) {
  if (!settings.models.empty()) {
    throw InputError("--model", "this experiment draws its objects itself; leave it out");
  }
  const ObjectBlock block(block_);
  const auto stem = settings.output / stem_name(settings);
  const auto file = shard_.rows_file(stem);
  Table table = continued_table(file, columns());
  std::set<std::uint64_t> done;
  for (const Row& row : table.rows()) {
    done.insert(static_cast<std::uint64_t>(table.number(row, "piece")));
  }
  const Interruption interruption;
  Progress progress(name(), shard_.runs_of(pieces_), settings.quiet, "pieces");
  std::size_t finished = done.size();
  for (std::uint64_t piece = 0; piece < pieces_ && !interruption.requested(); ++piece) {
    if (!shard_.holds(piece) || done.count(piece) > 0) continue;
    std::string wrong;
    const auto run_this = [&] {
      wrong = run_piece(block, piece, stem / std::to_string(piece), settings, table);
    };
    if (!is_done(run_this)) break;
    write_table(file, table);
    progress.update(++finished, wrong.empty() ? "right" : wrong);
  }
  progress.finish();
  report(stem);
  return !interruption.requested();
}

}  // namespace lockbox::app

// SPDX-License-Identifier: BSD-3-Clause
// Whether answers of other experiments that are believed by so much are right so often.
#include <iomanip>
#include <iostream>
#include <optional>

#include "experiments.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/reliability.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {
namespace {

/// What a row says, or nothing: no answer, or one that looks the same as the truth.
std::optional<StatedBelief> stated(const Table& table, const Row& row) {
  if (table.word(row, "status") == "initializing") return std::nullopt;
  if (table.has("looks_equal") && table.number(row, "looks_equal") != 0.0) return std::nullopt;
  const std::string verdict = table.has("within") ? "within" : "right";
  return StatedBelief{table.number(row, "belief"), table.word(row, "status") == "tracking",
                      table.number(row, verdict) != 0.0};
}

std::vector<StatedBelief> read_beliefs(const std::string& file) {
  const Table table = read_table(file);
  for (const char* column : {"belief", "status"}) {
    if (!table.has(column)) {
      throw InputError(file, 1,
                       "has no column '" + std::string(column) +
                           "': give rows of furniture, boards, household, shapes or global");
    }
  }
  if (!table.has("within") && !table.has("right")) {
    throw InputError(file, 1, "has neither a column 'within' nor 'right'");
  }
  std::vector<StatedBelief> runs;
  for (const Row& row : table.rows()) {
    if (const auto run = stated(table, row)) runs.push_back(*run);
  }
  return runs;
}

void print_bins(const std::vector<ReliabilityBin>& bins) {
  std::cout << "  belief            runs  right  mean belief  observed (95 %)\n";
  for (const ReliabilityBin& bin : bins) {
    if (bin.runs == 0) continue;
    std::cout << std::fixed << std::setprecision(3) << "  " << bin.lower << " to " << bin.upper
              << std::setw(8) << bin.runs << std::setw(7) << bin.right << std::setprecision(4)
              << std::setw(13) << bin.mean_belief << "  " << std::setprecision(3)
              << bin.observed.lower << " to " << bin.observed.upper
              << (bin.holds() ? "" : "  outside") << '\n';
  }
}

void print_scores(const std::string& what, const Scores& scores) {
  std::cout << std::fixed << std::setprecision(4) << "  " << std::left << std::setw(10) << what
            << std::right << " Brier score " << scores.brier << ", log loss " << scores.log_loss
            << '\n';
}

Figure diagram(const std::vector<ReliabilityBin>& bins) {
  Curve observed{"right", {}, {}};
  Curve lower{"95 %, from", {}, {}};
  Curve upper{"95 %, to", {}, {}};
  for (const ReliabilityBin& bin : bins) {
    if (bin.runs == 0) continue;
    const double right = static_cast<double>(bin.right) / static_cast<double>(bin.runs);
    for (const auto& [curve, value] : {std::pair{&observed, right},
                                       {&lower, bin.observed.lower},
                                       {&upper, bin.observed.upper}}) {
      curve->x.push_back(100.0 * bin.mean_belief);
      curve->y.push_back(100.0 * value);
    }
  }
  const Curve ideal{"as stated", {0.0, 100.0}, {0.0, 100.0}};
  return {"Reliability", {{"belief (%)", "observed (%)", {observed, lower, upper, ideal}}}};
}

class Reliability : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options
        .add_option("--rows", files_,
                    "Rows (.csv) that furniture, boards, household, shapes or global have written "
                    "(repeatable)")
        ->required()
        ->check(CLI::ExistingFile);
  }

  bool run(const ExperimentSettings& settings) override {
    if (!settings.models.empty()) {
      throw InputError("--model", "this experiment reads rows of others; leave it out");
    }
    std::vector<StatedBelief> all;
    for (const std::string& file : files_) {
      const std::vector<StatedBelief> runs = read_beliefs(file);
      std::cout << file << ": " << runs.size() << " answers\n";
      all.insert(all.end(), runs.begin(), runs.end());
    }
    const std::vector<ReliabilityBin> bins = reliability_bins(all);
    print_bins(bins);
    print_scores("belief", scores_of_belief(all));
    print_scores("constant", scores_of_constant(all));
    print_scores("status", scores_of_status(all));
    draw(settings.output / "reliability", diagram(bins));
    return true;
  }

 private:
  bool run_model(const ArticulatedModel& /*model*/,
                 const ExperimentSettings& /*settings*/) override {
    return true;
  }

  std::vector<std::string> files_;
};

}  // namespace

std::unique_ptr<Experiment> make_reliability_experiment() {
  return std::make_unique<Reliability>();
}

}  // namespace lockbox::app

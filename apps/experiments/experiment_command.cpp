// SPDX-License-Identifier: BSD-3-Clause
#include "experiment_command.hpp"

#include <iostream>
#include <optional>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments.hpp"
#include "lockbox/sensor/sensor_profile.hpp"

namespace lockbox::app {
namespace {

class ExperimentCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    add_common_options(options);
    options.require_subcommand(1);
    for (const ExperimentEntry& entry : experiments()) {
      CLI::App* own = options.add_subcommand(entry.name, entry.summary);
      own->fallthrough();  // to the common options
      own->footer("Common options: lockbox experiment --help\n\nExample:\n  lockbox experiment " +
                  entry.name + " --output out/" + entry.name);
      choices_.push_back({own, entry.make()});
      choices_.back().experiment->add_options(*own);
    }
  }

  ExitStatus run() override {
    for (const auto& model : settings_.models) find_model(model);
    make_folder(settings_.output);
    settings_.sensor_is_given = sensor_->count() > 0;
    for (const Choice& choice : choices_) {
      if (choice.options->parsed()) run(*choice.experiment);
    }
    return ExitStatus::done;
  }

 private:
  struct Choice {
    CLI::App* options;
    std::unique_ptr<Experiment> experiment;
  };

  void run(Experiment& experiment) const {
    std::optional<LastWords> words;
    if (!experiment.continues()) {
      words.emplace(
          ": the runs of the model at hand are lost, for they are written when all are done; the "
          "same command makes them anew, fewer of them take less time (see its --help)");
      if (!settings_.quiet) {
        std::cerr << "results are written when all runs of a model are done; Ctrl-C loses them\n";
      }
    }
    const bool finished = experiment.run(settings_);
    std::cout << "\nwritten: " << settings_.output.string() << '\n';
    if (!finished) std::cout << "interrupted; each run is written, the same command continues\n";
  }

  void add_common_options(CLI::App& options) {
    options
        .add_option("-m,--model", settings_.models,
                    "Models to run (repeatable): files, or shipped names; if none is given, those "
                    "that the experiment is about")
        ->check(suggested(shipped_models()))
        ->type_name("FILE")
        ->default_str("");
    options.add_option("-o,--output", settings_.output, "Folder for raw results and figures")
        ->required()
        ->check(folder_name())
        ->type_name("DIR");
    sensor_ = options.add_option("--sensor", settings_.sensor, sensor_names())
                  ->check(suggested(shipped_sensor_names()));
    options.add_option("--seed", settings_.seed, "Of all that is random, the sensor's noise too")
        ->check(not_negative());
    options.add_flag("-q,--quiet", settings_.quiet, "No progress");
  }

  ExperimentSettings settings_;
  CLI::Option* sensor_ = nullptr;
  std::vector<Choice> choices_;
};

}  // namespace

std::unique_ptr<Command> make_experiment_command() {
  return std::make_unique<ExperimentCommand>();
}

}  // namespace lockbox::app

// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <iostream>

#include "commands.hpp"
#include "counted.hpp"
#include "interruption.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "option_checks.hpp"
#include "output_paths.hpp"

namespace lockbox::app {
namespace {

class RecordCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options
        .add_option("-s,--source", source_, "openni2:, openni2:<uri>, or a recording of any kind")
        ->required()
        ->type_name("SOURCE");
    options.add_option("-o,--output", output_, "The recording to write")
        ->required()
        ->check(recording_name())
        ->type_name("FILE.oni");
    add_overwrite_option(options, overwrite_);
    options.add_option("--seconds", seconds_, "Stop after this time; 0: at Ctrl-C")
        ->check(not_negative());
    options.add_flag("-q,--quiet", quiet_, "Say nothing but errors");
  }

  ExitStatus run() override {
    require_source(source_);
    require_different(output_, source_);
    require_new(output_, overwrite_);
    make_folder_of(output_);
    const Interruption interruption;
    const auto start = std::chrono::steady_clock::now();
    const auto is_over = [&] {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      return interruption.requested() || (seconds_ > 0.0 && elapsed.count() >= seconds_);
    };
    if (!quiet_) std::cerr << "recording " << source_ << "; Ctrl-C ends\n";
    const auto warn = [](const std::string& text) {
      std::cerr << "lockbox: warning: " << text << '\n';
    };
    const std::size_t frames = record(source_, output_, is_over, warn);
    if (!quiet_) std::cout << counted(frames, "frame") << " in " << output_ << '\n';
    return ExitStatus::done;
  }

 private:
  std::string source_;
  std::string output_;
  double seconds_ = 0.0;
  bool overwrite_ = false;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_record_command() {
  return std::make_unique<RecordCommand>();
}

}  // namespace lockbox::app

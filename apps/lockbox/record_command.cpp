// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "source_options.hpp"

namespace lockbox::app {
namespace {

class RecordCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    source_.add_peaceful_to(options);
    options.add_option("-o,--output", output_, "The recording to write")
        ->required()
        ->check(recording_name())
        ->type_name("FILE.oni");
    add_overwrite_option(options, overwrite_);
    options
        .add_option("--seconds", seconds_,
                    "Stop after this time, that of the recording where one is the source; 0: at "
                    "its end, or Ctrl-C")
        ->check(not_negative());
    options.add_flag("-q,--quiet", quiet_, "Say nothing but errors");
  }

  ExitStatus run() override {
    source_.require_existing();
    require_different(output_, source_.name());
    require_new(output_, overwrite_);
    make_folder_of(output_);
    const Interruption interruption;
    RecordingEnd end{interruption::requested};
    if (seconds_ > 0.0) end.seconds = seconds_;
    if (!quiet_) std::cerr << "recording " << source_.name() << "; Ctrl-C ends\n";
    const std::size_t frames = record(source_.name(), output_, end, source_.options());
    if (!quiet_) std::cout << counted(frames, "frame") << " in " << output_ << '\n';
    return ExitStatus::done;
  }

 private:
  SourceArguments source_;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_reader.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

class ErrorCollector : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Sends console_bridge's messages, which are global to the process, to the collector.
class LogRedirection {
 public:
  explicit LogRedirection(ErrorCollector& collector) : lock_(mutex()) {
    console_bridge::useOutputHandler(&collector);
  }
  ~LogRedirection() { console_bridge::restorePreviousOutputHandler(); }
  LogRedirection(const LogRedirection&) = delete;
  LogRedirection& operator=(const LogRedirection&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
};

/// Links own their children: without this a long chain would be released recursively.
void release(urdf::ModelInterface* model) {
  for (auto& [name, link] : model->links_) {
    link->child_links.clear();
    link->child_joints.clear();
  }
  delete model;
}

}  // namespace

std::shared_ptr<const urdf::ModelInterface> read_urdf(const std::string& file,
                                                      const std::string& guarded_text) {
  ErrorCollector errors;
  const LogRedirection redirection{errors};
  const auto model = urdf::parseURDF(guarded_text);
  if (!model) throw InputError(file, "refused by the URDF reader: " + errors.text());
  return std::shared_ptr<const urdf::ModelInterface>(new urdf::ModelInterface(*model), release);
}

}  // namespace lockbox

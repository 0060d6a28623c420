// SPDX-License-Identifier: BSD-3-Clause
// Rows, summary and figure of `lockbox experiment absent`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox::app {

/// The kind of rows whose frames come from a recording.
inline constexpr const char* kRecordedRoom = "recording";

/// One room, or one recording.
struct AbsentRun {
  std::string kind;     ///< to_string(AbsentKind), or kRecordedRoom
  std::string number;   ///< of the room among those of its kind, or the recording
  std::string content;  ///< what stands there instead of the object

  std::string text() const { return kind + "_" + number; }
};

std::vector<std::string> absent_columns();

/// result: what the tracker made of that frame of the run.
void add_absent_row(Table& table, const AbsentRun& run, std::size_t frame,
                    const TrackingResult& result);

/// AbsentRun::text() of a row's run.
std::string run_of(const Table& table, const Row& row);

/// One line a kind, near misses after a line of their own; then every false alarm. Returns the
/// figure: how well what was found explained the image, and how long frames took.
Figure report_absent(const std::string& name, const std::vector<std::filesystem::path>& files);

}  // namespace lockbox::app

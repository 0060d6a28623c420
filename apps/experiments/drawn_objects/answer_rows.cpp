// SPDX-License-Identifier: BSD-3-Clause
#include "answer_rows.hpp"

#include <iomanip>
#include <iostream>

#include "lockbox/core/units.hpp"
#include "lockbox/tracking/tracking_status.hpp"

namespace lockbox::app {

bool is_trusted(const Table& table, const Row& row) {
  return table.word(row, "status") == to_string(TrackingStatus::tracking);
}

void print_wrong(const Table& table, const Row& row, const std::string& what) {
  std::cout << "  piece " << table.word(row, "piece") << what << ": " << table.word(row, "wrong")
            << ", " << std::fixed << std::setprecision(0)
            << kMillimetres * table.number(row, "translation") << " mm, "
            << kDegrees * table.number(row, "rotation") << " degrees, " << table.word(row, "status")
            << "; evidence " << table.number(row, "evidence") << ", of the truth "
            << table.number(row, "evidence_of_truth") << '\n';
}

}  // namespace lockbox::app

// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <fstream>
#include <locale>

#include "lockbox/core/csv_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/evaluation/global_experiment.hpp"

namespace lockbox {
namespace {

constexpr const char* kHeader =
    "scene,placement,cut_off,visible,distance,determined,right,translation,rotation,wrong,"
    "status,within,explained,contradicted,belief,seconds";
constexpr std::array<const char*, 3> kPlacements{"free", "on_table", "on_wall"};

Placement placement_of(const CsvRow& row, std::size_t column) {
  for (std::size_t i = 0; i < kPlacements.size(); ++i) {
    if (row.field(column) == kPlacements[i]) return static_cast<Placement>(i);
  }
  row.refuse(column, in_quotes(row.field(column)) + " is no placement");
}

TrackingStatus status_of(const CsvRow& row, std::size_t column) {
  for (const auto status : {TrackingStatus::initializing, TrackingStatus::tracking,
                            TrackingStatus::uncertain, TrackingStatus::lost}) {
    if (row.field(column) == to_string(status)) return status;
  }
  row.refuse(column, in_quotes(row.field(column)) + " is no status");
}

GlobalResult result_of(const CsvRow& row) {
  GlobalResult result;
  result.scene = static_cast<std::uint64_t>(row.number(0));
  result.placement = placement_of(row, 1);
  result.cut_off = row.number(2) != 0.0;
  result.visible = row.number(3);
  result.distance = row.number(4);
  result.determined = row.number(5) != 0.0;
  result.right = row.number(6) != 0.0;
  result.translation = row.number(7);
  result.rotation = row.number(8);
  result.wrong = row.field(9);
  result.status = status_of(row, 10);
  result.within = row.number(11) != 0.0;
  result.explained = row.number(12);
  result.contradicted = row.number(13);
  result.belief = row.number(14);
  result.seconds = row.number(15);
  return result;
}

}  // namespace

std::vector<GlobalResult> read_global_results(const std::filesystem::path& file) {
  CsvFile csv(file, UnfinishedRow::left_out);
  csv.require_header(kHeader, "such results");
  std::vector<GlobalResult> results;
  for (CsvRow row; csv.next(row);) results.push_back(result_of(row));
  return results;
}

void write_global_results(const std::filesystem::path& file,
                          const std::vector<GlobalResult>& results) {
  // Whatever ends the program, complete rows stay.
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished);
  out.imbue(std::locale::classic());
  out << kHeader << '\n';
  for (const GlobalResult& result : results) {
    out << result.scene << ',' << kPlacements[static_cast<std::size_t>(result.placement)];
    for (const double value : {result.cut_off ? 1.0 : 0.0, result.visible, result.distance,
                               result.determined ? 1.0 : 0.0, result.right ? 1.0 : 0.0,
                               result.translation, result.rotation}) {
      out << ',' << number_text(value);
    }
    out << ',' << result.wrong << ',' << to_string(result.status) << ','
        << (result.within ? '1' : '0') << ',' << number_text(result.explained) << ','
        << number_text(result.contradicted) << ',' << number_text(result.belief) << ','
        << number_text(result.seconds) << '\n';
  }
  out.close();
  if (!out) throw InputError(unfinished.string(), "cannot be written");
  std::filesystem::rename(unfinished, file);
}

}  // namespace lockbox

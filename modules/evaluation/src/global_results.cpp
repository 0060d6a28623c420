// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <fstream>
#include <locale>
#include <sstream>

#include "lockbox/core/csv_fields.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"
#include "lockbox/evaluation/global_experiment.hpp"

namespace lockbox {
namespace {

constexpr const char* kHeader =
    "scene,placement,cut_off,visible,distance,determined,right,translation,rotation,wrong,"
    "status,within,explained,contradicted,belief,seconds";
constexpr std::size_t kColumns = 16;
constexpr std::array<const char*, 3> kPlacements{"free", "on_table", "on_wall"};

Placement parse_placement(const std::string& file, int line, std::string_view word) {
  for (std::size_t i = 0; i < kPlacements.size(); ++i) {
    if (word == kPlacements[i]) return static_cast<Placement>(i);
  }
  throw InputError(file, line, "'" + std::string(word) + "' is no placement");
}

TrackingStatus parse_status(const std::string& file, int line, std::string_view word) {
  for (const auto status : {TrackingStatus::initializing, TrackingStatus::tracking,
                            TrackingStatus::uncertain, TrackingStatus::lost}) {
    if (word == to_string(status)) return status;
  }
  throw InputError(file, line, "'" + std::string(word) + "' is no status");
}

GlobalResult parse_row(const std::string& file, int line, std::string_view text) {
  const auto fields = split_fields(text);
  if (fields.size() != kColumns) {
    throw InputError(
        file, line,
        "has " + std::to_string(fields.size()) + " columns instead of " + std::to_string(kColumns));
  }
  const auto number = [&](std::size_t column) {
    const auto value = parse_number(fields[column]);
    if (!value) {
      throw InputError(file, line, "'" + std::string(fields[column]) + "' is no number");
    }
    return *value;
  };
  GlobalResult result;
  result.scene = static_cast<std::uint64_t>(number(0));
  result.placement = parse_placement(file, line, fields[1]);
  result.cut_off = number(2) != 0.0;
  result.visible = number(3);
  result.distance = number(4);
  result.determined = number(5) != 0.0;
  result.right = number(6) != 0.0;
  result.translation = number(7);
  result.rotation = number(8);
  result.wrong = fields[9];
  result.status = parse_status(file, line, fields[10]);
  result.within = number(11) != 0.0;
  result.explained = number(12);
  result.contradicted = number(13);
  result.belief = number(14);
  result.seconds = number(15);
  return result;
}

}  // namespace

std::vector<GlobalResult> read_global_results(const std::filesystem::path& file) {
  std::istringstream in(read_text_file(file));
  std::string text;
  std::getline(in, text);
  if (trimmed(text) != kHeader) {
    throw InputError(file.string(), 1,
                     std::string("is not the header of such results: ") + kHeader);
  }
  std::vector<GlobalResult> results;
  for (int line = 2; std::getline(in, text); ++line) {
    if (in.eof()) break;  // a row without its end was being written when the program ended
    results.push_back(parse_row(file.string(), line, trimmed(text)));
  }
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

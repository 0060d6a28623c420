// SPDX-License-Identifier: BSD-3-Clause
#include "alternatives_file.hpp"

#include <algorithm>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/model/states_file.hpp"
#include "plausible_states.hpp"

namespace lockbox::app {

AlternativesByStamp read_alternatives_beside(const std::filesystem::path& states,
                                             const KinematicTree& tree) {
  const auto file = states.parent_path() / "alternatives.csv";
  if (states.filename() != "states.csv" || !std::filesystem::exists(file)) return {};
  const StatesFile rows = read_states(file, tree);
  const std::vector<std::string>& columns = rows.extra_columns;
  const auto kind = std::find(columns.begin(), columns.end(), "kind") - columns.begin();
  const auto chance = std::find(columns.begin(), columns.end(), "probability") - columns.begin();
  const auto count = static_cast<std::ptrdiff_t>(columns.size());
  if (kind == count || chance == count) {
    throw InputError(file.string(), 1, "the columns 'kind' and 'probability' are missing");
  }
  require_plausible(file.string(), tree, rows.states);
  AlternativesByStamp alternatives;
  for (const State& row : rows.states) {
    const auto probability = parse_number(row.extra[static_cast<std::size_t>(chance)]);
    if (!row.known || !row.configuration.q.allFinite() || !probability) continue;
    alternatives[row.stamp].push_back(
        {alternative_name(row.extra[static_cast<std::size_t>(kind)], *probability),
         row.configuration});
  }
  return alternatives;
}

}  // namespace lockbox::app

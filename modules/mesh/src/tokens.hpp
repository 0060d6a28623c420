// SPDX-License-Identifier: BSD-3-Clause
// Lines and words of text files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lockbox {

/// Walks through the lines of a text without copying it.
class Lines {
 public:
  explicit Lines(std::string_view content) : rest_(content) {}

  /// False at the end of the text.
  bool next();

  std::string_view text() const { return text_; }
  int number() const { return number_; }  ///< from 1
  /// What follows the current line.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view text_;
  int number_ = 0;
};

/// Split at blanks, tabs and carriage returns; what follows a '#' is left out.
std::vector<std::string_view> words_of(std::string_view line);

bool is_finite_number(std::string_view word);

}  // namespace lockbox

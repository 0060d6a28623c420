// SPDX-License-Identifier: BSD-3-Clause
// Lines, words and numbers of text files, whatever the system that wrote them ends its lines with.
#pragma once

#include <string>
#include <string_view>

namespace lockbox {

/// Walks through the lines of a text without copying it. Lines end with LF, CR LF or CR.
class Lines {
 public:
  /// Skips the byte order mark that some editors begin a UTF-8 file with.
  explicit Lines(std::string_view content);

  /// False at the end of the text.
  bool next();

  std::string_view text() const { return text_; }
  int number() const { return number_; }  ///< from 1

 private:
  std::string_view rest_;
  std::string_view text_;
  int number_ = 0;
};

/// Removes the first word from a line, with the blanks before it; empty if there is none.
std::string_view take_word(std::string_view& line);

/// The number that a word of a file spells. Throws InputError with file and line unless it is
/// finite.
double finite_number(std::string_view word, const std::string& file, int line);

}  // namespace lockbox

// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "file_checks.hpp"
#include "lockbox/core/error.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

class ObjCheck {
 public:
  explicit ObjCheck(const std::filesystem::path& file) : file_(file.string()) {}

  void line(const std::vector<std::string_view>& words, int number) {
    number_ = number;
    if (words.empty()) {
      return;
    }
    if (words[0] == "v") {
      require_numbers(words, 3);
      ++counts_[0];
    } else if (words[0] == "vt") {
      require_numbers(words, 2);
      ++counts_[1];
    } else if (words[0] == "vn") {
      require_numbers(words, 3);
      ++counts_[2];
    } else if (words[0] == "f") {
      face(words);
    }
  }

  std::size_t faces() const { return faces_; }

 private:
  void require_numbers(const std::vector<std::string_view>& words, std::size_t count) const {
    if (words.size() < count + 1) {
      refuse("expected " + std::to_string(count) + " numbers after " + in_quotes(words[0]));
    }
    for (std::size_t i = 1; i <= count; ++i) {
      if (!is_finite_number(words[i])) {
        refuse(in_quotes(words[i]) + " is not a finite number");
      }
    }
  }

  void face(const std::vector<std::string_view>& words) {
    if (words.size() < 4) {
      refuse("a face needs at least three corners");
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      corner(words[i]);
    }
    ++faces_;
  }

  /// vertex, vertex/texture, vertex//normal or vertex/texture/normal.
  void corner(std::string_view word) const {
    constexpr std::array<const char*, 3> kKinds = {"vertex", "texture coordinate", "normal"};
    const std::string whole(word);
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view index = word.substr(0, slash);
      if (!index.empty() || kind == 0) {
        require_index(index, counts_[kind], kKinds[kind], whole);
      }
      if (slash == word.size()) {
        return;
      }
      word.remove_prefix(slash + 1);
    }
    refuse(in_quotes(whole) + " is not a corner");
  }

  void require_index(std::string_view text, long count, const char* kind,
                     const std::string& whole) const {
    long index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) {
      refuse(in_quotes(whole) + " is not a corner");
    }
    // Counted from 1; negative ones backwards from the last that was given.
    if (index == 0 || index > count || index < -count) {
      refuse("the face refers to " + std::string(kind) + " " + std::to_string(index) + " of " +
             std::to_string(count));
    }
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(file_, number_, problem);
  }

  std::string file_;
  int number_ = 0;
  std::array<long, 3> counts_ = {};  ///< vertices, texture coordinates, normals so far
  std::size_t faces_ = 0;
};

}  // namespace

std::size_t check_obj(const std::filesystem::path& file, const std::string& content) {
  ObjCheck check(file);
  Lines lines(content);
  while (lines.next()) {
    check.line(words_of(lines.text()), lines.number());
  }
  return check.faces();
}

}  // namespace lockbox

// Lines and words of a text file, with errors that name the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "talus/base/error.h"

namespace talus {

// Reads a text that outlives it. Lines end in LF or CRLF; from `#` on a line is comment; a
// backslash at its end continues it.
class TextReader {
 public:
  TextReader(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

  // Moves to the next line that has a word; false at the end.
  bool next_line();
  // The next word of the current line; empty when there is none.
  std::string_view word();
  // The next word, of this line or a later one; throws at the end of the text.
  std::string_view word_across_lines();

  // The next word of the line as a number; throws `Error` (input) if it is missing or is none.
  double number();
  std::int64_t integer();

  double to_number(std::string_view word) const;
  std::int64_t to_integer(std::string_view word) const;

  // An input error that names file and line.
  Error error(std::string_view what) const;

 private:
  bool take_line();
  std::string_view word_or_throw();

  std::string_view rest_;
  std::string_view line_;
  std::uint64_t line_number_ = 0;
  std::string path_;
};

}  // namespace talus

#include "talus/io/text_reader.h"

#include <fmt/format.h>

#include <charconv>

namespace talus {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

// Words come from broken files too: shown short, unprintable bytes as dots.
std::string shown(std::string_view word) {
  std::string out(word.substr(0, 24));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '.';
  return out;
}

template <class T>
bool parse(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

bool TextReader::take_line() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  line_ = line_.substr(0, line_.find('#'));
  const std::size_t last = line_.find_last_not_of(kBlanks);
  line_ = line_.substr(0, last == std::string_view::npos ? 0 : last + 1);
  ++line_number_;
  return true;
}

bool TextReader::next_line() {
  while (take_line())
    if (line_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
  return false;
}

std::string_view TextReader::word() {
  for (;;) {
    const std::size_t begin = line_.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    line_.remove_prefix(begin);
    if (line_ != "\\") break;
    if (!take_line()) return line_ = {};
  }
  std::size_t end = std::min(line_.find_first_of(kBlanks), line_.size());
  if (end == line_.size() && line_.back() == '\\') --end;
  const std::string_view found = line_.substr(0, end);
  line_.remove_prefix(end);
  return found;
}

std::string_view TextReader::word_across_lines() {
  for (;;) {
    if (const std::string_view found = word(); !found.empty()) return found;
    if (!next_line()) throw error("the file ends too early");
  }
}

std::string_view TextReader::word_or_throw() {
  const std::string_view found = word();
  if (found.empty()) throw error("the line ends too early");
  return found;
}

double TextReader::number() { return to_number(word_or_throw()); }
std::int64_t TextReader::integer() { return to_integer(word_or_throw()); }

double TextReader::to_number(std::string_view word) const {
  double value = 0;
  if (!parse(word, value)) throw error(fmt::format("\"{}\" is not a number", shown(word)));
  return value;
}

std::int64_t TextReader::to_integer(std::string_view word) const {
  std::int64_t value = 0;
  if (!parse(word, value)) throw error(fmt::format("\"{}\" is not a whole number", shown(word)));
  return value;
}

Error TextReader::error(std::string_view what) const {
  return input_error(fmt::format("{}, line {}: {}", path_, line_number_, what));
}

}  // namespace talus

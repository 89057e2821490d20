#include "talus/base/describe.h"

#include <charconv>

namespace talus {

RelativeLength parse_relative_length(std::string_view text) {
  RelativeLength length;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto [rest, error] = std::from_chars(begin, end, length.value);
  const std::string_view suffix(rest, static_cast<std::size_t>(end - rest));
  if (error != std::errc() || !std::isfinite(length.value) || (suffix != "" && suffix != "%"))
    throw usage_error(fmt::format(
        "\"{}\" is no length; write metres (0.25) or a share of the longest side (4%)", text));
  if (suffix == "%") {
    length.value /= 100;
    length.unit = RelativeLength::Unit::fraction;
  }
  return length;
}

std::string to_string(const RelativeLength& length) {
  if (length.unit == RelativeLength::Unit::metres) return fmt::format("{}", length.value);
  // The product has rounded, so its shortest digits may be many; take the fewest that read back.
  const double percent = 100 * length.value;
  for (int digits = 6; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}%", percent, digits);
    if (parse_relative_length(text) == length) return text;
  }
  return fmt::format("{:.17g}%", percent);
}

namespace detail {

void check_number(std::string_view path, const Field& f, double value) {
  if (value >= f.min && value <= f.max && std::isfinite(value)) return;
  const std::string unit = f.unit.empty() ? "" : fmt::format(" {}", f.unit);
  std::string allowed = "finite";
  if (std::isfinite(f.min) && std::isfinite(f.max))
    allowed = fmt::format("from {} to {}{}", f.min, f.max, unit);
  else if (std::isfinite(f.min))
    allowed = fmt::format("at least {}{}", f.min, unit);
  else if (std::isfinite(f.max))
    allowed = fmt::format("at most {}{}", f.max, unit);
  throw usage_error(
      fmt::format("{} = {}{} is out of range; it must be {}", path, value, unit, allowed));
}

}  // namespace detail

}  // namespace talus

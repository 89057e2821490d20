#include "talus/base/suggest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace talus {
namespace {

// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

// The first of the nearest names; null if none is near.
const std::string* nearest_of(std::string_view wrong, std::span<const std::string> names) {
  const std::string lower = lower_case(wrong);
  const std::string* nearest = nullptr;
  std::size_t least = 0;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(lower, name);
    if (nearest && distance >= least) continue;
    nearest = &name;
    least = distance;
  }
  if (!nearest || wrong.empty()) return nullptr;
  // Near is: at most a third of the letters are wrong, and one is right.
  const std::size_t letters = std::max(wrong.size(), nearest->size());
  return least <= (letters + 2) / 3 && least < letters ? nearest : nullptr;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool is_near(std::string_view wrong, std::span<const std::string> names) {
  return nearest_of(wrong, names) != nullptr;
}

std::string suggest(std::string_view wrong, std::span<const std::string> names) {
  if (const std::string* nearest = nearest_of(wrong, names))
    return fmt::format("did you mean \"{}\"?", *nearest);
  return fmt::format("there {} {}", names.size() == 1 ? "is only" : "are", fmt::join(names, ", "));
}

}  // namespace talus

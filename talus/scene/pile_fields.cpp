#include "talus/scene/pile_fields.h"

namespace talus {

void read_value(const Value& value, const std::string& path, StoneId& out) {
  std::vector<int> numbers;
  if (value.array()) read_value(value, path, numbers);
  if (numbers.size() != 3 && numbers.size() != 4)
    fail_at(value.where, path, "no stone; write [x, y, z] of its cell, or [x, y, z, seed]");
  constexpr int kFarthest = 100'000'000;
  for (const int n : numbers)
    if (n < -kFarthest || n > kFarthest)
      fail_at(value.where, path, fmt::format("{} is out of range; cells go to {}", n, kFarthest));
  out = {.cell = {numbers[0], numbers[1], numbers[2]}, .seed = numbers.size() > 3 ? numbers[3] : 0};
}

Value write_value(const StoneId& stone) {
  std::vector<int> numbers = {stone.cell.x, stone.cell.y, stone.cell.z};
  if (stone.seed != 0) numbers.push_back(stone.seed);
  return write_value(numbers);
}

std::string type_name(const StoneId&) { return "[x, y, z] or [x, y, z, seed]"; }

}  // namespace talus

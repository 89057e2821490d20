// A formula as a list of steps for a machine with a stack.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace talus {

struct FormulaProgram {
  enum class Op : std::uint8_t {
    number,
    x,
    y,
    z,
    add,
    subtract,
    multiply,
    divide,
    power,
    negate,
    less,
    less_equal,
    both,
    either,
    negation,
    abs,
    min,
    max,
    clamp,
    floor,
    ceil,
    fract,
    mod,
    sqrt,
    hypot,
    length,
    sin,
    cos,
    tan,
    atan2,
    exp,
    log,
    mix,
    smoothstep,
    step,
    noise,
  };
  struct Step {
    Op op;
    double value = 0;  // of a number
  };
  static constexpr int kDepthMax = 48;

  // Each takes its arguments, the last on top, from the stack and leaves one value there.
  std::vector<Step> steps;
  int depth = 0;  // values that wait at once, at most
};

// Reads a condition, such as "z < 0.2 * sin(x) and z > 0", whose last value is a truth. Throws
// `Error` (usage) with the column of what is wrong.
FormulaProgram parse_formula(std::string_view text);

}  // namespace talus

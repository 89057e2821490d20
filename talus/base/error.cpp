#include "talus/base/error.h"

#include <cstdlib>
#include <iostream>

namespace talus {

void assertion_failed(const char* condition, const char* file, int line) {
  std::cerr << file << ':' << line << ": assertion failed: " << condition << '\n';
  std::abort();
}

}  // namespace talus

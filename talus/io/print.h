// Formatted text into a file.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

#include "talus/io/atomic_file.h"

namespace talus {

template <class... Args>
void print(AtomicFile& file, fmt::format_string<Args...> format, Args&&... args) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  file.write(std::string_view(text.data(), text.size()));
}

}  // namespace talus

// What somebody meant who wrote a name that there is not.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace talus {

// With a to z for A to Z.
std::string lower_case(std::string_view text);

// Whether one of `names` is nearly `wrong`: few letters differ, capitals aside.
bool is_near(std::string_view wrong, std::span<const std::string> names);

// `did you mean "stone_size"?` for the nearest of `names`, or a list of them all if none is near.
std::string suggest(std::string_view wrong, std::span<const std::string> names);

}  // namespace talus

// How the choices of pile parameters are written in recipes.
#pragma once

#include "talus/piles/pile_params.h"
#include "talus/scene/fields.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<Membership> = std::to_array<EnumName<Membership>>(
    {{Membership::anchors, "anchors"}, {Membership::center, "center"}});

}  // namespace talus

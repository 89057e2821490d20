// How the choices of tile parameters are written in recipes.
#pragma once

#include "talus/rocks/tile_params.h"
#include "talus/scene/fields.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<Variety> =
    std::to_array<EnumName<Variety>>({{Variety::aperiodic, "aperiodic"},
                                      {Variety::columns, "columns"},
                                      {Variety::periodic, "periodic"}});
template <>
inline constexpr auto kEnumNames<SeedPlacement> = std::to_array<EnumName<SeedPlacement>>(
    {{SeedPlacement::low_discrepancy, "low_discrepancy"}, {SeedPlacement::poisson, "poisson"}});
template <>
inline constexpr auto kEnumNames<Frames> =
    std::to_array<EnumName<Frames>>({{Frames::random, "random"}, {Frames::bedded, "bedded"}});

}  // namespace talus

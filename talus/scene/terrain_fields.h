// Terrain's own types as fields of recipes.
#pragma once

#include <string>

#include "talus/io/raster_reader.h"
#include "talus/scene/fields.h"
#include "talus/terrain/material.h"
#include "talus/tools/deposit.h"
#include "talus/tools/set_surface.h"
#include "talus/tools/stroke.h"
#include "talus/tools/sweep.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<SurfaceChange> =
    std::to_array<EnumName<SurfaceChange>>({{SurfaceChange::set, "set"},
                                            {SurfaceChange::raise, "raise"},
                                            {SurfaceChange::lower, "lower"}});
template <>
inline constexpr auto kEnumNames<DepositProfile> =
    std::to_array<EnumName<DepositProfile>>({{DepositProfile::constant, "constant"},
                                             {DepositProfile::cone, "cone"},
                                             {DepositProfile::dome, "dome"},
                                             {DepositProfile::noise, "noise"},
                                             {DepositProfile::map, "map"}});
template <>
inline constexpr auto kEnumNames<HoleMode> =
    std::to_array<EnumName<HoleMode>>({{HoleMode::fill, "fill"}, {HoleMode::keep, "keep"}});
template <>
inline constexpr auto kEnumNames<Resampling> =
    std::to_array<EnumName<Resampling>>({{Resampling::nearest, "nearest"},
                                         {Resampling::bilinear, "bilinear"},
                                         {Resampling::cubic, "cubic"}});

// By name, as the table of materials has it.
void read_value(const Value& value, const std::string& path, Material& out);
Value write_value(Material material);
std::string type_name(Material);

// A list of names.
void read_value(const Value& value, const std::string& path, MaterialSet& out);
Value write_value(const MaterialSet& materials);
std::string type_name(const MaterialSet&);

// [x, y] or [x, y, z].
void read_value(const Value& value, const std::string& path, SurfacePoint& out);
Value write_value(const SurfacePoint& point);
std::string type_name(const SurfacePoint&);

// A point alone, or a table.
void read_value(const Value& value, const std::string& path, SweepNode& out);
Value write_value(const SweepNode& node);
std::string type_name(const SweepNode&);

// [from, to].
void read_value(const Value& value, const std::string& path, SweepArc& out);
Value write_value(const SweepArc& arc);
std::string type_name(const SweepArc&);

}  // namespace talus

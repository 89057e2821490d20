// The surface of the bedrock near a place.
#pragma once

#include <optional>

#include "talus/terrain/layered_terrain.h"

namespace talus {

constexpr MaterialSet kBedrockOnly{Material::bedrock};

// The half-integer number of columns, at least 1.5 and within what a field can have, that is
// nearest to a length; as a length.
double half_integer_columns(double length, const TerrainGrid& grid);

struct SurfacePlace {
  Vec3 point;
  Vec3 normal;   // out of the bedrock
  double sigma;  // of the field whose surface it is
};

// The place on the surface of the bedrock's `TerrainField` to which its gradient leads, at most
// sigma away. Sigma is the widest; or, where that shows no surface near the point as on thin walls,
// the half-integer number of columns nearest to half of it and so on, down to 1.5 columns.
std::optional<SurfacePlace> find_bedrock_surface(const LayeredTerrain& terrain, const Vec3& point,
                                                 double widest_sigma);

}  // namespace talus

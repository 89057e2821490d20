#include "talus/scene/surface_params.h"

namespace talus {

void read_value(const Value& value, const std::string& path, SurfaceParams& out) {
  read_fields(value, path, out);
  if (out.color && out.albedo)
    fail_at(value.where, path, "\"color\" has no effect beside \"albedo\"; leave one of them out");
}

}  // namespace talus

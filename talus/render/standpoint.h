// Where a person stands in a scene.
#pragma once

#include "talus/base/view_params.h"
#include "talus/render/render_scene.h"

namespace talus {

struct Standpoint {
  Vec3 eye{0};
  Vec3 target{0};
};

// A person on the scene's highest surface below `params.eye`, looking to `params.target`; without
// them, on the side of `params.azimuth_deg`, where the view toward the scene's middle shows most.
// Eyes are 1.7 m above the ground, less in a scene not much larger.
Standpoint find_standpoint(const RenderScene& scene, const ViewParams& params);

}  // namespace talus

// One picture of a scene, without a display.
#pragma once

#include "talus/base/image.h"
#include "talus/base/job.h"
#include "talus/base/view_params.h"
#include "talus/render/render_scene.h"

namespace talus {

// Red, green, blue. Equal input gives equal bytes on one driver. Throws `Error` (usage) for wrong
// params or a position that is not finite, (job) if there is no OpenGL or it fails; `Cancelled`.
Image render_picture(const RenderScene& scene, const ViewParams& params = {}, Job* job = nullptr);

}  // namespace talus

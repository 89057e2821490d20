// Who says where the camera stands: the recipe, or the command line.
#pragma once

#include "apps/talus/command.h"

namespace talus::cli {

// Takes from the document's [view] what would keep the command's options and settings from placing
// the camera: an eye where it gives an azimuth, an elevation, a zoom or a camera, and these where
// it gives an eye. What the command itself gives stays, contradictions too.
void let_command_place_camera(Value& document, const Command& command);

}  // namespace talus::cli

// How a picture is taken: what recipes say and renderers do.
#pragma once

#include <optional>

#include "talus/base/describe.h"

namespace talus {

// Where the camera stands.
enum class CameraPreset {
  overview,  // above the scene, as far away as its bounds ask for, looking at its middle
  low,       // on the ground, at the height of a person's eyes, looking at the middle of the scene
  inside,    // at `eye` in a cave or under a roof: exposed for the light that finds its way in
};

// Azimuths are compass directions: where the camera or the sun stands as seen from the scene,
// clockwise from north (+y), so that 90 is east (+x). `eye` and `target`, given together, place the
// camera by hand, whatever azimuth, elevation and zoom are; a low one then stands on the ground at
// the eye's x and y.
struct ViewParams {
  CameraPreset camera = CameraPreset::overview;
  int width = 1280;
  int height = 720;
  double azimuth_deg = 200;
  std::optional<double> elevation_deg;
  double field_of_view_deg = 30;
  double zoom = 1;
  std::optional<Vec3> eye;
  std::optional<Vec3> target;
  double sun_azimuth_deg = 132;
  double sun_elevation_deg = 36;
  bool ground = true;

  static void describe(auto& p, auto&& field) {
    field(
        p.camera,
        Field{.name = "camera",
              .help = "where the camera stands: above the scene, low on the ground, or inside, at "
                      "`eye`, with the exposure that a cave asks for"});
    field(p.width, Field{.name = "width",
                         .help = "columns of the picture",
                         .unit = "pixels",
                         .min = 16,
                         .max = 4096});
    field(p.height, Field{.name = "height",
                          .help = "rows of the picture",
                          .unit = "pixels",
                          .min = 16,
                          .max = 4096});
    field(p.azimuth_deg, Field{.name = "azimuth_deg",
                               .help = "where the camera stands, clockwise from north",
                               .unit = "degrees",
                               .min = -360,
                               .max = 360});
    field(p.elevation_deg, Field{.name = "elevation_deg",
                                 .help = "how high the camera stands above the horizon; by "
                                         "default 16, with terrain 30",
                                 .unit = "degrees",
                                 .min = -89,
                                 .max = 89});
    field(p.field_of_view_deg, Field{.name = "field_of_view_deg",
                                     .help = "vertical angle that the picture spans",
                                     .unit = "degrees",
                                     .min = 1,
                                     .max = 120});
    field(p.zoom, Field{.name = "zoom",
                        .help = "how much closer the camera comes; 1 shows all",
                        .min = 0.05,
                        .max = 100});
    field(p.eye, Field{.name = "eye",
                       .help = "where the camera is, instead of `azimuth_deg`, `elevation_deg` and "
                               "`zoom`; needs `target`",
                       .unit = "m"});
    field(p.target,
          Field{.name = "target", .help = "what the camera looks at; needs `eye`", .unit = "m"});
    field(p.sun_azimuth_deg, Field{.name = "sun_azimuth_deg",
                                   .help = "where the sun stands, clockwise from north",
                                   .unit = "degrees",
                                   .min = -360,
                                   .max = 360});
    field(p.sun_elevation_deg, Field{.name = "sun_elevation_deg",
                                     .help = "how high the sun stands above the horizon",
                                     .unit = "degrees",
                                     .min = 2,
                                     .max = 90});
    field(p.ground,
          Field{.name = "ground", .help = "stand a scene without terrain on a plane of earth"});
  }
};

}  // namespace talus

#include "apps/talus/picture.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "talus/field/shape.h"
#include "talus/io/image_reader.h"
#include "talus/mesh/creases.h"
#include "talus/piles/section.h"
#include "talus/piles/specimens.h"
#include "talus/render/picture.h"
#include "talus/terrain/material.h"

namespace talus::cli {
namespace {

constexpr int kSpecimens = 40;
constexpr double kContactRadius = 0.04;  // as it is drawn, in cells
constexpr double kCreaseDeg = 60;        // faces of a file's mesh that turn by more meet in an edge

// By the materials' numbers.
constexpr std::array<SurfaceLook::Pattern, kMaterialCount> kPatterns = {
    SurfaceLook::Pattern::rock,   SurfaceLook::Pattern::sand,  SurfaceLook::Pattern::soil,
    SurfaceLook::Pattern::gravel, SurfaceLook::Pattern::plain, SurfaceLook::Pattern::ice,
    SurfaceLook::Pattern::snow,   SurfaceLook::Pattern::plain};

// Null if there are none.
std::shared_ptr<const SurfaceImages> read_images(const SurfaceParams& surface,
                                                 std::string_view material) {
  SurfaceImages images{.size = surface.size};
  bool any = false;
  const auto read = [&](std::string_view key, const std::optional<std::filesystem::path>& file,
                        Image& image) {
    if (!file) return;
    any = true;
    try {
      image = read_image(*file);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("surfaces.{}.{}: {}", material, key, error.what()));
    }
  };
  read("albedo", surface.albedo, images.albedo);
  read("normal", surface.normal, images.normal);
  read("roughness", surface.roughness, images.roughness);
  read("height", surface.height, images.height);
  return any ? std::make_shared<const SurfaceImages>(std::move(images)) : nullptr;
}

void add_terrain(const TriangleMesh& ground, const Vec3& ground_origin, const TriangleMesh& water,
                 const Vec3& water_origin, const std::vector<SurfaceLook>& looks,
                 RenderScene& scene) {
  scene.surfaces = looks;
  scene.stone_color = mean_color(looks[index(Material::bedrock)]);
  if (!ground.triangles.empty()) scene.meshes = {{.mesh = &ground, .origin = ground_origin}};
  if (!water.triangles.empty()) scene.water = {{.mesh = &water, .origin = water_origin}};
}

void check_section(double height, double low, double high, std::string_view unit) {
  if (height >= low && height <= high) return;
  throw usage_error(fmt::format("--section {}: the stones lie from {:.4g} to {:.4g} {}", height,
                                low, high, unit));
}

}  // namespace

std::vector<SurfaceLook> read_looks(const SurfacesParams& surfaces) {
  std::vector<SurfaceLook> looks;
  for (std::size_t m = 0; m < kPatterns.size(); ++m) {
    const SurfaceParams& surface = surfaces.of_material[m];
    SurfaceLook& look = looks.emplace_back(SurfaceLook{.pattern = kPatterns[m]});
    if (surface.color) look.color = Vec3f(*surface.color);
    look.images = read_images(surface, material_infos()[m].name);
  }
  return looks;
}

Image draw(const BuildResult& result, const std::vector<SurfaceLook>& looks, Job* job) {
  RenderScene scene{.stones = &result.stones, .ground = result.plane};
  if (const auto& terrain = result.terrain)
    add_terrain(terrain->ground.mesh, terrain->ground.origin, terrain->water,
                terrain->ground.origin, looks, scene);
  return render_picture(scene, result.recipe.view, job);
}

Image draw(const SceneFile& file, const std::vector<SurfaceLook>& looks, const ViewParams& view,
           Job* job) {
  RenderScene scene{.stones = &file.stones, .ground = file.plane};
  if (!file.ground.positions.empty() || !file.water.positions.empty())
    add_terrain(file.ground, file.ground_origin, file.water, file.water_origin, looks, scene);
  return render_picture(scene, view, job);
}

Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job) {
  const TriangleMesh shaded = with_creased_normals(mesh, kCreaseDeg);
  return render_picture({.meshes = {{.mesh = &shaded}}, .ground = bounds(mesh).min.z}, view, job);
}

Image draw(const TileSet& tiles, const ViewParams& view, Job* job) {
  const InstanceTable stones = specimens(tiles, kSpecimens);
  return render_picture({.stones = &stones, .ground = 0.0}, view, job);
}

ViewParams specimens_view() {
  ViewParams view;
  view.azimuth_deg = 180;  // rows run from left to right
  view.elevation_deg = 50;
  view.zoom = 1.3;
  return view;
}

Image draw_section(const InstanceTable& stones, double height, int width) {
  const Box3 box = bounds(stones);
  check_section(height, box.min.z, box.max.z, "m");
  return talus::draw_section(
      stones, {.height = height, .min = Vec2(box.min), .max = Vec2(box.max), .width = width});
}

Image draw_section(const std::shared_ptr<const TileSet>& tiles, double height, int width) {
  check_section(height, 0, 2 * (tiles->params().n - 1), "cells");
  // Around what is drawn stones are needed that reach into it.
  const double margin = std::ceil(tiles->reach()) + 2, side = 2 * (tiles->params().n - 1);
  const double z = margin + height;
  const Vec3 size(side + 2 * margin, side + 2 * margin, z + margin);
  const Pile pile = fill(ShapeSupport(Box{.center = 0.5 * size, .size = size}), tiles,
                         {.stone_size = {1, RelativeLength::Unit::metres}});
  const Section section{
      .height = z, .min = Vec2(margin), .max = Vec2(margin + side), .width = width};
  return talus::draw_section(instances(pile), section, contacts_near(pile, z), kContactRadius);
}

}  // namespace talus::cli

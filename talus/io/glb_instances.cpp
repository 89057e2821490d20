#include "talus/io/glb_instances.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <string>

#include "talus/io/gltf_document.h"

namespace talus {
namespace {

using nlohmann::json;

json list(const Vec3& v) { return {v.x, v.y, v.z}; }

template <class Row>
std::size_t add_rows(GlbFile& file, const std::vector<Row>& rows) {
  const std::size_t bytes = rows.size() * sizeof(Row);
  return file.add_view(bytes, 0, 0,
                       [&rows, bytes](AtomicFile& out) { out.write(rows.data(), bytes); });
}

}  // namespace

std::array<double, 4> y_up(const Quat& rotation) {
  const glm::dquat q = glm::normalize(glm::dquat(rotation));
  return {q.x, q.z, -q.y, q.w};
}

GlbInstances::GlbInstances(const InstanceTable& stones, const Vec3& center, double step)
    : stones_(stones), center_(center), step_(step), cells_(split_into_cells(stones)) {
  translations_.reserve(stones.instances.size());
  for (const InstanceCell& cell : cells_.cells)
    for (const InstanceRun& run : cell.runs) {
      const bool alike = is_alike(run);
      const Frame frame = frame_of(run);
      const Vec3 origin = origin_of(cell);
      for (std::size_t i = run.first; i < run.first + run.count; ++i) {
        const Vec3 away = (instance(i).position - origin) / frame.scale;
        translations_.emplace_back(y_up(glm::conjugate(frame.rotation) * away));
        if (alike) continue;
        const auto [x, y, z, w] = y_up(instance(i).rotation);
        rotations_.emplace_back(x, y, z, w);
        scales_.emplace_back(instance(i).scale);
      }
    }
}

bool GlbInstances::is_alike(const InstanceRun& run) const {
  const Instance& first = instance(run.first);
  for (std::size_t i = run.first; i < run.first + run.count; ++i)
    if (instance(i).rotation != first.rotation || instance(i).scale != first.scale) return false;
  return true;
}

GlbInstances::Frame GlbInstances::frame_of(const InstanceRun& run) const {
  if (!is_alike(run)) return {.scale = step_};
  const Instance& first = instance(run.first);
  return {.rotation = glm::normalize(glm::dquat(first.rotation)), .scale = step_ * first.scale};
}

// Rounded so that it is short in the file.
Vec3 GlbInstances::origin_of(const InstanceCell& cell) const {
  return glm::round(cell.positions.center());
}

GlbInstances::Views GlbInstances::add_views(GlbFile& file) const {
  Views views{.translations = add_rows(file, translations_)};
  if (rotations_.empty()) return views;
  views.rotations = add_rows(file, rotations_);
  views.scales = add_rows(file, scales_);
  return views;
}

std::vector<std::size_t> GlbInstances::add_to(GlbFile& file, std::size_t first_mesh) const {
  file.require_extension(kInstancingExtension);
  const Views views = add_views(file);
  std::vector<std::size_t> cell_nodes;
  std::uint64_t turned = 0;  // rows of rotations and scales that earlier runs have
  for (std::size_t c = 0; c < cells_.cells.size(); ++c) {
    const InstanceCell& cell = cells_.cells[c];
    json children = json::array();
    for (const InstanceRun& run : cell.runs) {
      json attributes = {{"TRANSLATION", file.add_accessor(views.translations, 12 * run.first,
                                                           kFloat, "VEC3", run.count)}};
      json node = {{"name", fmt::format("stones/{}/{}", c, run.prototype)},
                   {"mesh", first_mesh + run.prototype}};
      const Frame frame = frame_of(run);
      if (frame.scale != 1) node["scale"] = list(Vec3(frame.scale));
      if (is_alike(run)) {
        if (instance(run.first).rotation != Quat(1, 0, 0, 0))
          node["rotation"] = y_up(instance(run.first).rotation);
      } else {
        attributes["ROTATION"] =
            file.add_accessor(views.rotations, 16 * turned, kFloat, "VEC4", run.count);
        attributes["SCALE"] =
            file.add_accessor(views.scales, 12 * turned, kFloat, "VEC3", run.count);
        turned += run.count;
      }
      node["extensions"] = {{kInstancingExtension, {{"attributes", std::move(attributes)}}}};
      children.push_back(file.add("nodes", std::move(node)));
    }
    cell_nodes.push_back(file.add("nodes", {{"name", fmt::format("stones/{}", c)},
                                            {"translation", list(y_up(origin_of(cell) - center_))},
                                            {"children", std::move(children)}}));
  }
  return cell_nodes;
}

}  // namespace talus

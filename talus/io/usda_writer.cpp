#include "talus/io/usda_writer.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "talus/io/dressed_mesh.h"
#include "talus/io/material_color.h"
#include "talus/io/print.h"

namespace talus {
namespace {

constexpr float kWaterOpacity = 0.6f;
constexpr std::size_t kProgressPrototypes = 16;

std::string text(const Vec3f& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string text(const Vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

// Prims, attributes and arrays, each on lines of its own.
class UsdaFile {
 public:
  explicit UsdaFile(const std::filesystem::path& path) : file_(path) {
    file_.write(
        "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    doc = \"Talus\"\n    metersPerUnit = 1\n"
        "    upAxis = \"Z\"\n)\n");
  }

  void open(const std::string& prim) {
    print(file_, "\n{0}{1}\n{0}{{\n", indent_, prim);
    indent_ += "    ";
  }
  void close() {
    indent_.resize(indent_.size() - 4);
    print(file_, "{}}}\n", indent_);
  }

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    file_.write(indent_);
    print(file_, format, std::forward<Args>(args)...);
    file_.write("\n");
  }

  // `entry(i)` prints what the array has at i.
  template <class Entry>
  void array(const std::string& name, std::size_t count, Entry&& entry, const char* metadata = "") {
    print(file_, "{}{} = [", indent_, name);
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) file_.write(", ");
      entry(file_, i);
    }
    print(file_, "]{}\n", metadata);
  }

  void points(const std::string& name, const std::vector<Vec3f>& values,
              const char* metadata = "") {
    array(
        name, values.size(),
        [&](AtomicFile& file, std::size_t i) {
          print(file, "({}, {}, {})", values[i].x, values[i].y, values[i].z);
        },
        metadata);
  }

  void translate(const Vec3& to) {
    line("double3 xformOp:translate = {}", text(to));
    line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  }

  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
  std::string indent_;
};

constexpr const char* kPerVertex = " (\n            interpolation = \"vertex\"\n        )";

void write_triangles(const TriangleMesh& mesh, UsdaFile& file) {
  const Box3 box = bounds(mesh);
  file.line("float3[] extent = [{}, {}]", text(Vec3f(box.min)), text(Vec3f(box.max)));
  file.array("int[] faceVertexCounts", mesh.triangles.size(),
             [](AtomicFile& out, std::size_t) { out.write("3"); });
  file.array("int[] faceVertexIndices", mesh.triangles.size(), [&](AtomicFile& out, std::size_t i) {
    const Triangle& t = mesh.triangles[i];
    print(out, "{}, {}, {}", t.x, t.y, t.z);
  });
  file.points("point3f[] points", mesh.positions);
  if (mesh.normals.empty()) {
    TriangleMesh computed{.positions = mesh.positions, .triangles = mesh.triangles};
    compute_normals(computed);
    file.points("normal3f[] normals", computed.normals, kPerVertex);
  } else {
    file.points("normal3f[] normals", mesh.normals, kPerVertex);
  }
  file.line("uniform token subdivisionScheme = \"none\"");
}

void write_shares(const TriangleMesh& mesh, UsdaFile& file) {
  file.array(
      "color3f[] primvars:displayColor", mesh.shares.size(),
      [&](AtomicFile& out, std::size_t i) { out.write(text(blended_color(mesh.shares[i]))); },
      kPerVertex);
  for (std::size_t m = 0; m < kMaterialCount; ++m) {
    const bool shows = std::any_of(mesh.shares.begin(), mesh.shares.end(),
                                   [&](const MaterialShares& shares) { return shares[m] > 0; });
    if (!shows) continue;
    file.array(
        fmt::format("float[] primvars:{}", material_infos()[m].name), mesh.shares.size(),
        [&](AtomicFile& out, std::size_t i) {
          print(out, "{}", static_cast<float>(mesh.shares[i][m]) / 255.0f);
        },
        kPerVertex);
  }
}

void write_surface(const char* name, const PlacedMesh& placed, Material material, UsdaFile& file) {
  if (!placed.mesh || placed.mesh->triangles.empty()) return;
  const TriangleMesh& mesh = *placed.mesh;
  file.open(
      fmt::format("def Mesh \"{}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                  "    )",
                  name));
  write_triangles(mesh, file);
  if (mesh.shares.empty())
    file.line("color3f[] primvars:displayColor = [{}]", text(material_info(material).color));
  else
    write_shares(mesh, file);
  file.line("rel material:binding = </scene/materials/{}>", name);
  file.translate(placed.origin);
  file.close();
}

void write_prototypes(const InstanceTable& stones, std::uint64_t seed, UsdaFile& file, Job* job) {
  file.open("def Scope \"prototypes\"");
  for (std::size_t k = 0; k < stones.prototypes.size(); ++k) {
    if (k % kProgressPrototypes == 0)
      report_progress(job, "write USD",
                      static_cast<double>(k) / static_cast<double>(stones.prototypes.size()));
    file.open(
        fmt::format("def Mesh \"stone_{}\" (\n"
                    "                prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                    "            )",
                    k));
    write_triangles(*stones.prototypes[k], file);
    file.line("color3f[] primvars:displayColor = [{}]",
              text(stone_tint(seed, static_cast<std::uint32_t>(k))));
    file.line("rel material:binding = </scene/materials/stones>");
    file.close();
  }
  file.close();
}

// Around all instances, relative to `center`.
Box3 extent_of(const InstanceTable& stones, const Vec3& center) {
  std::vector<double> reach;
  for (const auto& prototype : stones.prototypes) {
    double farthest = 0;
    for (const Vec3f& p : prototype->positions) farthest = std::max(farthest, glm::length(Vec3(p)));
    reach.push_back(farthest);
  }
  Box3 box;
  for (const Instance& instance : stones.instances) {
    const Vec3 away = instance.position - center;
    const double radius = reach[instance.prototype] * instance.scale;
    box.include(Box3{away - radius, away + radius});
  }
  return box;
}

void write_places(const InstanceTable& stones, const Vec3& center, UsdaFile& file) {
  const std::vector<Instance>& instances = stones.instances;
  const auto none = [&](auto&& differs) {
    return std::none_of(instances.begin(), instances.end(), differs);
  };
  file.array("int[] protoIndices", instances.size(),
             [&](AtomicFile& out, std::size_t i) { print(out, "{}", instances[i].prototype); });
  file.array("point3f[] positions", instances.size(), [&](AtomicFile& out, std::size_t i) {
    const Vec3f p(instances[i].position - center);
    print(out, "({}, {}, {})", p.x, p.y, p.z);
  });
  if (!none([](const Instance& i) { return i.rotation != Quat(1, 0, 0, 0); }))
    file.array("quath[] orientations", instances.size(), [&](AtomicFile& out, std::size_t i) {
      const Quat& q = instances[i].rotation;
      print(out, "({}, {}, {}, {})", q.w, q.x, q.y, q.z);
    });
  if (!none([](const Instance& i) { return i.scale != 1; }))
    file.array("float3[] scales", instances.size(), [&](AtomicFile& out, std::size_t i) {
      print(out, "({0}, {0}, {0})", instances[i].scale);
    });
}

void write_stones(const InstanceTable& stones, std::uint64_t seed, UsdaFile& file, Job* job) {
  Box3 positions;
  for (const Instance& instance : stones.instances) positions.include(instance.position);
  const Vec3 center = glm::round(positions.center());
  const Box3 extent = extent_of(stones, center);
  file.open("def PointInstancer \"stones\"");
  file.line("float3[] extent = [{}, {}]", text(Vec3f(extent.min)), text(Vec3f(extent.max)));
  write_places(stones, center, file);
  file.array("rel prototypes", stones.prototypes.size(), [](AtomicFile& out, std::size_t k) {
    print(out, "</scene/stones/prototypes/stone_{}>", k);
  });
  file.translate(center);
  write_prototypes(stones, seed, file, job);
  file.close();
}

void write_material(const char* name, float roughness, float opacity, UsdaFile& file) {
  const std::string path = fmt::format("/scene/materials/{}", name);
  file.open(fmt::format("def Material \"{}\"", name));
  file.line("token outputs:surface.connect = <{}/surface.outputs:surface>", path);
  file.open("def Shader \"surface\"");
  file.line("uniform token info:id = \"UsdPreviewSurface\"");
  file.line("color3f inputs:diffuseColor.connect = <{}/color.outputs:result>", path);
  file.line("float inputs:metallic = 0");
  file.line("float inputs:roughness = {}", roughness);
  if (opacity < 1) file.line("float inputs:opacity = {}", opacity);
  file.line("token outputs:surface");
  file.close();
  file.open("def Shader \"color\"");
  file.line("uniform token info:id = \"UsdPrimvarReader_float3\"");
  file.line("string inputs:varname = \"displayColor\"");
  file.line("float3 outputs:result");
  file.close();
  file.close();
}

}  // namespace

void write_usda(const std::filesystem::path& path, const SceneView& scene, std::uint64_t seed,
                Job* job) {
  check_cancelled(job);
  UsdaFile file(path);
  file.open("def Xform \"scene\"");
  write_surface("ground", scene.ground, Material::bedrock, file);
  write_surface("water", scene.water, Material::water, file);
  if (scene.stones && !scene.stones->instances.empty())
    write_stones(*scene.stones, seed, file, job);
  file.open("def Scope \"materials\"");
  write_material("ground", 0.95f, 1, file);
  write_material("water", 0.05f, kWaterOpacity, file);
  write_material("stones", 0.85f, 1, file);
  file.close();
  file.close();
  file.commit();
}

}  // namespace talus

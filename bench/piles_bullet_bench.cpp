// What a pile of stones that touch costs by rigid bodies: Bullet drops convex hulls into a box
// until they rest, with the defaults of its library.
#include <btBulletDynamicsCommon.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/field/shape.h"
#include "talus/piles/pile.h"

namespace talus {
namespace {

constexpr double kStep = 1.0 / 60;  // s
constexpr double kRest = 1e-4;      // kinetic energy by mass, m^2/s^2: 14 mm/s
constexpr int kRestSteps = 30, kMostSteps = 3600;
constexpr float kFriction = 0.7f;  // of a body; a pair's is the product

double draw(int i, int what, double low, double high) {
  return uniform(hash(3, Purpose::seed_position, i, what), low, high);
}

// A lump about a metre wide.
std::unique_ptr<btConvexHullShape> lump(int i) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (int k = 0; k < 24; ++k) {
    const Vec3 p(draw(i, 3 * k, -1, 1), draw(i, 3 * k + 1, -1, 1), draw(i, 3 * k + 2, -1, 1));
    const Vec3 q = 0.5 * p / std::max(glm::length(p), 1e-6);
    shape->addPoint(btVector3(float(q.x), float(q.y), 0.8f * float(q.z)), false);
  }
  shape->recalcLocalAabb();
  shape->setMargin(0.01f);
  return shape;
}

// Bodies in a box of four walls and a floor.
class World {
 public:
  explicit World(int count) : side_(std::cbrt(2 * count * 0.45)) {
    world_.setGravity({0, 0, -9.81f});
    const auto half = static_cast<float>(side_ / 2);
    add_plane({0, 0, 1}, 0);
    for (const float s : {-1.0f, 1.0f}) {
      add_plane({s, 0, 0}, -half);
      add_plane({0, s, 0}, -half);
    }
    for (int i = 0; i < 64; ++i) hulls_.push_back(lump(i));
    const int row = std::max(1, static_cast<int>((side_ - 0.2) / 1.25));
    for (int i = 0; i < count; ++i) {
      const auto at = [&](int k) { return -side_ / 2 + side_ / row * (k + 0.5); };
      const Vec3 p(at(i % row), at(i / row % row), 0.8 + 1.25 * (i / (row * row)));
      add(*hulls_[static_cast<std::size_t>(i % 64)], 1000,
          {float(p.x + draw(i, 100, -0.05, 0.05)), float(p.y + draw(i, 101, -0.05, 0.05)),
           float(p.z)});
    }
  }
  ~World() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Simulated seconds until all rest.
  double settle() {
    int calm = 0, steps = 0;
    for (; steps < kMostSteps && calm < kRestSteps; ++steps) {
      world_.stepSimulation(float(kStep), 0);
      calm = energy_by_mass() < kRest && steps > 60 ? calm + 1 : 0;
    }
    return steps * kStep;
  }

 private:
  void add_plane(const btVector3& normal, float offset) {
    planes_.push_back(std::make_unique<btStaticPlaneShape>(normal, offset));
    add(*planes_.back(), 0, {0, 0, 0});
  }
  void add(btCollisionShape& shape, float mass, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(at);
    info.m_friction = kFriction;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_.addRigidBody(bodies_.back().get());
  }
  double energy_by_mass() const {
    double energy = 0, mass = 0;
    for (const auto& body : bodies_) {
      if (body->getInvMass() == 0) continue;
      const double m = 1 / body->getInvMass();
      mass += m;
      if (!body->isActive()) continue;
      energy += 0.5 * m * body->getLinearVelocity().length2();
      const btVector3 turning =
          body->getWorldTransform().getBasis().transpose() * body->getAngularVelocity();
      for (int axis = 0; axis < 3; ++axis)
        energy += 0.5 * turning[axis] * turning[axis] / body->getInvInertiaDiagLocal()[axis];
    }
    return energy / mass;
  }

  double side_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  std::vector<std::unique_ptr<btCollisionShape>> planes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// As many stones by both: time a stone, the making of the tiles included in ours, and their ratio.
void pile_against_bullet(benchmark::State& state) {
  const ThreadLimit limit(1);
  const auto count = static_cast<int>(state.range(0));
  for (auto _ : state) {
    auto start = std::chrono::steady_clock::now();
    const double simulated = World(count).settle();
    const double theirs = seconds_since(start) / count;

    start = std::chrono::steady_clock::now();
    const auto tiles = std::make_shared<const TileSet>(TileSet::make({}, 1));
    const double edge = std::cbrt(count / 0.5);
    const ShapeSupport box(Box{.size = {edge, edge, edge / 2}});
    const Pile pile = fill(box, tiles, {.stone_size = {1}});
    const double ours = seconds_since(start) / static_cast<double>(pile.stats.instances);

    state.counters["simulated_s"] = simulated;
    state.counters["bullet_us_per_stone"] = 1e6 * theirs;
    state.counters["talus_us_per_stone"] = 1e6 * ours;
    state.counters["ratio"] = theirs / ours;
  }
}
BENCHMARK(pile_against_bullet)
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->ArgName("stones")
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace talus

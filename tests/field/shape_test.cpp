#include "talus/field/shape.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "field/blocks.h"
#include "talus/base/hash.h"

namespace talus {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 random_point(const Box3& box, int i) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = uniform(hash(21, Purpose::texture, i, axis), box.min[axis], box.max[axis]);
  return p;
}

std::vector<Shape> samples() {
  const Sphere sphere{{0.2, 0, 0}, 1.1};
  const Box box{{0, 0.3, 0}, {2, 1, 1.5}, 0.2};
  const Capsule capsule{{0, 0, 0}, {1, 1, 2}, 0.6, 0.2};
  const Cylinder cylinder{{0, 0, -1}, 0.7, 2};
  using Rule = Combination::Rule;
  return {sphere,
          box,
          capsule,
          cylinder,
          Raked{{0.1, 0, -0.2}, {3, 2.5}, 0.1, 0.2, 0.3, 20, {{0.4, 0.3, 0.8}, {-0.5, 0.2, 0.6}}},
          Spiral{{0, 0.1, 0}, 0.3, 1.5, 0.4, 0.2, 0.5},
          Combination{Rule::intersect, 0, {box, Courses{0.1, 0.3, 0.05}}},
          Combination{Rule::join, 0.3, {sphere, box, capsule}},
          Combination{Rule::subtract, 0.1, {box, sphere}},
          Combination{Rule::intersect, 0, {box, cylinder}}};
}

// Blending far and near.
Shape crowd(Combination::Rule rule) {
  Combination all{rule, 0.15, {}};
  for (int i = 0; i < 30; ++i) {
    const double radius = uniform(hash(4, Purpose::texture, i), 0.2, 0.8);
    all.parts.push_back(Sphere{random_point({Vec3(-2), Vec3(2)}, i), radius});
  }
  if (rule == Combination::Rule::subtract) all.parts.front() = Box{Vec3(0), Vec3(3.5)};
  if (rule == Combination::Rule::intersect)
    for (Shape& part : all.parts) std::get<Sphere>(part).radius += 2.6;
  return all;
}

double monte_carlo_volume(const ShapeSupport& support) {
  constexpr int kPoints = 200000;
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) inside += support.contains(random_point(support.bounds(), i));
  const Vec3 s = support.bounds().size();
  return s.x * s.y * s.z * inside / kPoints;
}

TEST(Shape, PrimitivesHaveTheirVolumes) {
  EXPECT_NEAR(monte_carlo_volume(ShapeSupport(Sphere{{1, 2, 3}, 2})), 4.0 / 3 * kPi * 8, 0.2);
  EXPECT_NEAR(monte_carlo_volume(ShapeSupport(Box{{1, 2, 3}, {1, 2, 3}, 0})), 6, 1e-9);
  EXPECT_NEAR(monte_carlo_volume(ShapeSupport(Cylinder{{0, 0, 5}, 0.5, 4})), kPi, 0.03);
  EXPECT_NEAR(monte_carlo_volume(ShapeSupport(Capsule{{0, 0, 0}, {0, 3, 0}, 1, 1})),
              kPi * 3 + 4.0 / 3 * kPi, 0.1);
}

TEST(Shape, BlocksAnswerAsPointsAndBoxesDo) {
  using Rule = Combination::Rule;
  std::vector<Shape> shapes = samples();
  for (const Rule rule : {Rule::join, Rule::subtract, Rule::intersect}) {
    shapes.push_back(crowd(rule));
    shapes.push_back(Combination{Rule::join, 0.3, {crowd(rule), Box{Vec3(1), Vec3(1)}}});
  }
  for (const Shape& shape : shapes) {
    const ShapeSupport support(shape);
    for (int i = 0; i < 400; ++i)
      test::expect_answers_as_for_one(support, test::random_block(support.bounds(), i), i);
  }
}

TEST(Shape, CapsuleOfTwoRadiiIsTheHullOfItsBalls) {
  const Capsule capsule{{0, 0, 0}, {2, 0, 0}, 1, 0.25};
  // The side is a cone whose angle has sine (1 - 0.25) / 2, so that it lies at distance
  // r - x sine from a point x along the axis.
  const double sine = 0.375;
  const DistanceFunction distance = distance_function(capsule);
  EXPECT_NEAR(distance({1, 0, 0}), -(1 - 1 * sine), 1e-12);
  EXPECT_NEAR(distance({-1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(distance({2.25, 0, 0}), 0, 1e-12);
  const Capsule swallowed{{0, 0, 0}, {0.1, 0, 0}, 1, 0.25};
  EXPECT_NEAR(distance_function(swallowed)({0, 0, 3}), 2, 1e-12);
}

TEST(Shape, DistanceNeverExceedsTheTrueOne) {
  for (const Shape& shape : samples()) {
    const DistanceFunction distance = distance_function(shape);
    const Box3 box = bounds(shape).expanded(0.5);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 p = random_point(box, 2 * i), q = random_point(box, 2 * i + 1);
      ASSERT_LE(std::abs(distance(p) - distance(q)), glm::length(p - q) * (1 + 1e-9));
    }
  }
}

TEST(Shape, ClassifiedBoxesAnswerAlikeEverywhere) {
  for (const Shape& shape : samples()) {
    const ShapeSupport support(shape);
    const Box3 box = support.bounds().expanded(0.5);
    int certain = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 center = random_point(box, i);
      const Box3 query{center - 0.1, center + 0.1};
      const BoxState state = support.classify(query);
      if (state == BoxState::mixed) continue;
      ++certain;
      for (int k = 0; k < 20; ++k)
        ASSERT_EQ(support.contains(random_point(query, 100 * i + k)), state == BoxState::inside);
    }
    EXPECT_GT(certain, 500);
  }
}

TEST(Shape, BoundsHoldTheShapeAndAreTight) {
  for (const Shape& shape : samples()) {
    const ShapeSupport support(shape);
    const Box3 tight = support.bounds();
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p = random_point(tight.expanded(0.5), i);
      ASSERT_TRUE(!support.contains(p) || tight.contains(p));
    }
    for (int axis = 0; axis < 3; ++axis) {
      Box3 slab = tight;
      slab.max[axis] = slab.min[axis] + 0.04 * tight.longest_side();
      bool touched = false;
      for (int i = 0; i < 40000 && !touched; ++i) touched = support.contains(random_point(slab, i));
      EXPECT_TRUE(touched);
    }
  }
}

TEST(Shape, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(ShapeSupport(Sphere{{0, 0, 0}, -1}), Error);
  EXPECT_THROW(ShapeSupport(Box{{0, 0, 0}, {1, 1, 1}, 0.6}), Error);
  EXPECT_THROW(ShapeSupport(Combination{}), Error);
  EXPECT_THROW(ShapeSupport(Combination{
                   Combination::Rule::intersect, 0, {Sphere{{0, 0, 0}, 1}, Sphere{{5, 0, 0}, 1}}}),
               Error);
}

}  // namespace
}  // namespace talus

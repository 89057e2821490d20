// Several supports as one.
#pragma once

#include <memory>
#include <vector>

#include "talus/field/support.h"

namespace talus {

// What any of its parts holds; nothing without parts.
class JoinedSupport final : public Support {
 public:
  explicit JoinedSupport(std::vector<std::unique_ptr<const Support>> parts)
      : parts_(std::move(parts)) {}

  bool contains(const Vec3& p) const override {
    for (const auto& part : parts_)
      if (part->contains(p)) return true;
    return false;
  }
  std::uint64_t contains_block(const PointBlock& block) const override {
    std::uint64_t bits = 0;
    for (const auto& part : parts_) bits |= part->contains_block(block);
    return bits;
  }
  BoxState classify(const Box3& box) const override {
    BoxState joined = BoxState::outside;
    for (const auto& part : parts_) {
      const BoxState state = part->classify(box);
      if (state == BoxState::inside) return state;
      if (state == BoxState::mixed) joined = state;
    }
    return joined;
  }
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override {
    BlockStates joined{.outside = ~std::uint64_t{0}};
    for (const auto& part : parts_) {
      const BlockStates states = part->classify_block(centers, half);
      joined.inside |= states.inside;
      joined.outside &= states.outside;
    }
    return joined;
  }
  Box3 bounds() const override {
    Box3 box;
    for (const auto& part : parts_) box.include(part->bounds());
    return box;
  }

 private:
  std::vector<std::unique_ptr<const Support>> parts_;
};

}  // namespace talus

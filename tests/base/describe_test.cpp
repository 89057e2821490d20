#include "talus/base/describe.h"

#include <gtest/gtest.h>

namespace talus {
namespace {

struct Inner {
  Range depth{0.1, 0.2};
  static void describe(auto& p, auto&& field) {
    field(p.depth, Field{.name = "depth", .help = "", .min = 0, .max = 1});
  }
};

struct Outer {
  int n = 5;
  std::optional<int> voxels;
  Inner inner;
  static void describe(auto& p, auto&& field) {
    field(p.n, Field{.name = "n", .help = "", .unit = "cells", .min = 5, .max = 16});
    field(p.voxels, Field{.name = "voxels", .help = "", .min = 2});
    field(p.inner, Field{.name = "inner", .help = ""});
  }
};

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

TEST(Describe, AcceptsDefaults) { EXPECT_NO_THROW(validate(Outer{}, "tiles")); }

TEST(Describe, NamesFieldValueUnitAndRange) {
  EXPECT_EQ(message_of([] { validate(Outer{.n = 4}, "tiles"); }),
            "tiles.n = 4 cells is out of range; it must be from 5 to 16 cells");
}

TEST(Describe, ChecksOptionalFieldsOnlyWhenGiven) {
  EXPECT_EQ(message_of([] { validate(Outer{.voxels = 1}); }),
            "voxels = 1 is out of range; it must be at least 2");
}

TEST(Describe, ReachesNestedStructs) {
  EXPECT_EQ(message_of([] {
              validate(Outer{.inner = {.depth = {0.1, 7}}}, "tiles");
            }),
            "tiles.inner.depth = 7 is out of range; it must be from 0 to 1");
  EXPECT_EQ(message_of([] {
              validate(Outer{.inner = {.depth = {0.3, 0.2}}});
            }),
            "inner.depth: range [0.3, 0.2] is reversed; give the smaller value first");
}

TEST(Describe, RefusesNumbersThatAreNotFinite) {
  EXPECT_NE(message_of([] { validate(Inner{.depth = {NAN, 1}}); }), "");
}

TEST(RelativeLength, ReadsMetresAndShares) {
  EXPECT_EQ(parse_relative_length("0.25"), (RelativeLength{0.25, RelativeLength::Unit::metres}));
  EXPECT_EQ(parse_relative_length("4%").in_metres(10), 0.4);
  EXPECT_EQ(to_string(parse_relative_length("4%")), "4%");
  EXPECT_EQ(to_string(parse_relative_length("0.25")), "0.25");
}

TEST(RelativeLength, TextReadsBackTheSame) {
  for (const double value : {0.04, 0.03, 1.0 / 3, 0.07, 1e-9, 0.123456789012345678}) {
    for (const auto unit : {RelativeLength::Unit::metres, RelativeLength::Unit::fraction}) {
      const RelativeLength length{value, unit};
      const RelativeLength back = parse_relative_length(to_string(length));
      EXPECT_EQ(back.unit, unit);
      EXPECT_DOUBLE_EQ(back.value, value);
    }
  }
  EXPECT_EQ(to_string(RelativeLength{0.07, RelativeLength::Unit::fraction}), "7%");
}

TEST(RelativeLength, RefusesAnythingElse) {
  for (const char* text : {"", "%", "4 %", "four", "4m", "nan", "inf", "1e999", "4%%"})
    EXPECT_NE(message_of([&] { parse_relative_length(text); }), "") << text;
}

}  // namespace
}  // namespace talus

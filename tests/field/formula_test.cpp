#include "talus/field/formula.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "field/blocks.h"
#include "talus/base/error.h"

namespace talus {
namespace {

const Box3 kBox{Vec3(-2), Vec3(2)};

std::uint64_t drawn(int i, int which) { return hash(17, Purpose::texture, i, which); }

Vec3 point_in(const Box3& box, int i) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = uniform(drawn(i, axis), box.min[axis], box.max[axis]);
  return p;
}

bool holds(std::string_view condition, const Vec3& p = Vec3(0.5, -0.25, 0.75)) {
  return FormulaSupport(condition, kBox).contains(p);
}

std::string refusal(std::string_view condition) {
  try {
    FormulaSupport(condition, kBox);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "read";
}

// A formula by chance, of every operation there is.
class Draw {
 public:
  explicit Draw(int i) : i_(i) {}

  std::string condition(int depth) {
    if (depth == 0 || chance(3) == 0)
      return fmt::format("{} {} {}", number(depth), pick({"<", "<=", ">", ">="}), number(depth));
    if (chance(4) == 0) return fmt::format("not ({})", condition(depth - 1));
    return fmt::format("({}) {} ({})", condition(depth - 1), pick({"and", "or"}),
                       condition(depth - 1));
  }

 private:
  std::uint64_t chance(std::uint64_t n) { return drawn(i_, 100 + count_++) % n; }
  std::string pick(std::initializer_list<const char*> words) {
    return words.begin()[chance(words.size())];
  }
  std::string number(int depth) {
    if (depth == 0) return pick({"x", "y", "z", "x", "y", "z", "0.5", "-1.25", "2", "3", "pi"});
    const auto deeper = [&] { return number(depth - 1); };
    const std::string a = deeper(), b = deeper(), c = deeper();
    switch (chance(5)) {
      case 0:
        return fmt::format("({} {} {})", a, pick({"+", "-", "*", "/", "^"}), b);
      case 1:
        return fmt::format("(-{})", a);
      case 2:
        return fmt::format(
            "{}({})",
            pick({"abs", "floor", "ceil", "fract", "sqrt", "sin", "cos", "tan", "exp", "log"}), a);
      case 3:
        return fmt::format("{}({}, {})",
                           pick({"min", "max", "mod", "hypot", "atan2", "pow", "step"}), a, b);
      default:
        return fmt::format("{}({}, {}, {})",
                           pick({"clamp", "mix", "smoothstep", "noise", "length"}), a, b, c);
    }
  }

  int i_;
  int count_ = 0;
};

TEST(Formula, MeansWhatMathematicsDoes) {
  EXPECT_TRUE(holds("x < 0.51 and x > 0.49 and not y > z"));
  EXPECT_TRUE(holds("1 + 2 * 3 ^ 2 <= 19 and 1 + 2 * 3 ^ 2 >= 19"));
  EXPECT_TRUE(holds("-2 ^ 2 <= -4 and 2 ^ -1 <= 0.5 and 2 ^ 3 ^ 2 >= 512"));
  EXPECT_TRUE(holds("8 / 4 / 2 <= 1 and 8 - 4 - 2 <= 2"));
  EXPECT_TRUE(holds("1 < 2 or 1 < 2 and 2 < 1"));  // and binds stronger
  EXPECT_TRUE(holds("not 1 < 2 and 2 < 1 or 1 < 2"));
  EXPECT_TRUE(holds("abs(sin(pi / 6) - 0.5) < 1e-12 and abs(atan2(1, -1) - 0.75 * pi) < 1e-12"));
  EXPECT_TRUE(holds("abs(exp(log(3)) - 3) < 1e-12 and abs(pow(2, 0.5) - sqrt(2)) < 1e-12"));
  EXPECT_TRUE(holds("hypot(3, 4) <= 5 and hypot(3, 4) >= 5 and length(2, 3, 6) >= 7"));
  EXPECT_TRUE(holds("mod(-1, 3) >= 2 and fract(2.75) >= 0.75 and floor(-0.5) <= -1"));
  EXPECT_TRUE(holds("mix(2, 4, 0.25) <= 2.5 and clamp(7, 0, 1) <= 1 and ceil(0.1) >= 1"));
  EXPECT_TRUE(holds("smoothstep(0, 1, 0.5) >= 0.5 and step(0.4, x) >= 1 and step(0.6, x) <= 0"));
  EXPECT_TRUE(holds("abs(noise(1, 2, 3)) <= 0 and abs(noise(x, y, z)) > 0"));
  EXPECT_TRUE(holds("((x)) < .6e0"));
}

TEST(Formula, HoldsInItsBoxAlone) {
  const FormulaSupport all("1 < 2", kBox);
  EXPECT_TRUE(all.contains(Vec3(2)));
  EXPECT_FALSE(all.contains(Vec3(2.001, 0, 0)));
  EXPECT_EQ(all.classify({Vec3(-1), Vec3(1)}), BoxState::inside);
  EXPECT_EQ(all.classify({Vec3(-1), Vec3(3)}), BoxState::mixed);
  EXPECT_EQ(all.classify({Vec3(3), Vec3(4)}), BoxState::outside);
}

TEST(Formula, LeavesWhatIsNoNumberOutside) {
  EXPECT_FALSE(holds("sqrt(-1) < 1"));
  EXPECT_FALSE(holds("not sqrt(-1) < 1"));
  EXPECT_FALSE(holds("0 / 0 > 0 or 0 / 0 <= 0"));
  EXPECT_FALSE(holds("min(0 / 0, 0) < 1 or max(1, 0 / 0) > 0"));
  EXPECT_TRUE(holds("x > 0 or sqrt(-1) < 1"));
  EXPECT_FALSE(holds("x > 0 and sqrt(-1) < 1"));
}

TEST(Formula, FollowsItsSeed) {
  const FormulaSupport a("noise(x, y, z) > 0", kBox, 1), b("noise(x, y, z) > 0", kBox, 2);
  int differ = 0;
  for (int i = 0; i < 1000; ++i)
    differ += a.contains(point_in(kBox, i)) != b.contains(point_in(kBox, i));
  EXPECT_GT(differ, 300);
}

TEST(Formula, BlocksAnswerAsPointsAndBoxesDo) {
  for (int i = 0; i < 400; ++i) {
    const FormulaSupport support(Draw(i).condition(2), kBox);
    test::expect_answers_as_for_one(support, test::random_block(kBox, i), i);
  }
}

TEST(Formula, ClassifiedBoxesAnswerAlikeEverywhere) {
  int decided = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string condition = Draw(i).condition(2);
    const FormulaSupport support(condition, kBox);
    const Vec3 corner = point_in(kBox, 3 * i);
    const double size = std::ldexp(1, -static_cast<int>(drawn(i, 8) % 10));
    const Box3 box{corner, corner + size};
    const BoxState state = support.classify(box);
    if (state == BoxState::mixed) continue;
    ++decided;
    for (int k = 0; k < 50; ++k) {
      Vec3 p = point_in(box, 100 * i + k);
      // Borders, too.
      for (int axis = 0; axis < 3; ++axis)
        if (drawn(k, 20 + axis) % 3 == 0) p[axis] = k % 2 ? box.min[axis] : box.max[axis];
      ASSERT_EQ(support.contains(p), state == BoxState::inside) << condition;
    }
  }
  EXPECT_GT(decided, 2000);
}

// The share of a ball's boxes that are decided tells whether intervals are of use.
TEST(Formula, SmallBoxesAreMostlyDecided) {
  for (const char* condition :
       {"hypot(x, y) < 1 and abs(z) < 1", "z < 0.5 + 0.1 * sin(6 * hypot(x, y))",
        "z < noise(x, y, 0)", "mod(x, 0.5) < 0.25"}) {
    const FormulaSupport support(condition, kBox);
    int mixed = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = point_in(kBox, i);
      mixed += support.classify({p, p + 0.02}) == BoxState::mixed;
    }
    EXPECT_LT(mixed, 250) << condition;
  }
}

TEST(Formula, RefusesWithTheColumn) {
  EXPECT_EQ(refusal("z < 0.2 + sine(x)"),
            "column 11: unknown name \"sine\"; did you mean \"sin\"?");
  EXPECT_EQ(refusal(""), "column 1: the formula is empty; write for example z < 1");
  EXPECT_EQ(refusal("z <"), "column 4: the formula ends where a value should be");
  EXPECT_EQ(refusal("z < * 2"), "column 5: \"*\" where a value should be");
  EXPECT_EQ(refusal("(z < 1"), "column 7: \")\" is missing for the \"(\" in column 1");
  EXPECT_EQ(refusal("z + 1"),
            "column 1: the formula is a number; compare it, for example with \"< 0\"");
  EXPECT_EQ(refusal("z < 1 and x"), "column 11: a number where a condition should be");
  EXPECT_EQ(refusal("2 * (z < 1) > 0"), "column 5: a condition where a number should be");
  EXPECT_EQ(refusal("0 < z < 1"), "column 7: comparisons do not chain; write a < b and b < c");
  EXPECT_EQ(refusal("min(x) < 1"), "column 6: \",\" is missing here: min takes 2 arguments");
  EXPECT_EQ(refusal("z < 1 x"),
            "column 7: \"x\" does not belong here; an operator or the end should");
  EXPECT_EQ(refusal("z = 1"), "column 3: \"=\" has no meaning in a formula");
  EXPECT_EQ(refusal("z < 1e999"), "column 5: a number that cannot be read");
}

TEST(Formula, RefusesWhatIsTooLongOrDeep) {
  EXPECT_EQ(refusal(std::string(10'001, ' ')),
            "the formula has 10001 characters; at most 10000 are read");
  for (const std::string_view part : {"(", "abs(", "-", "2^", "clamp(x, y, "}) {
    std::string deep;
    while (deep.size() < 9000) deep += part;
    EXPECT_NE(refusal(deep).find("nested too deeply"), std::string::npos) << part;
  }
  std::string many = "0";
  while (many.size() < 9000) many += " + x";
  EXPECT_EQ(refusal(many + " < 1"), "read");
}

TEST(Formula, SurvivesAnyText) {
  constexpr std::array kPieces = {"x", "y",   "(",   ")",    "+",   "-",  "*", "/",   "^",
                                  "<", ">=",  "and", "or",   "not", "1",  ".", "1e5", "sin(",
                                  ",", "pow", "%",   "\xff", " ",   "\n", "e", "nan"};
  int read = 0;
  for (int i = 0; i < 20'000; ++i) {
    // Pieces in any order, or a formula with one character replaced.
    std::string text;
    if (i % 2) {
      text = Draw(i).condition(1);
      text[drawn(i, 2) % text.size()] = "x1+(,) <.^"[drawn(i, 3) % 10];
    } else {
      for (int k = 0; k < static_cast<int>(drawn(i, 0) % 12); ++k)
        text += kPieces[drawn(i, 1 + k) % kPieces.size()];
    }
    if (refusal(text) != "read") continue;
    ++read;
    FormulaSupport(text, kBox).contains(Vec3(1));
  }
  EXPECT_GT(read, 100);
}

TEST(FunctionSupport, AsksItsFunction) {
  const FunctionSupport half([](const Vec3& p) { return p.x < 0; }, kBox);
  EXPECT_TRUE(half.contains(Vec3(-1)));
  EXPECT_FALSE(half.contains(Vec3(1)));
  EXPECT_FALSE(half.contains(Vec3(-3)));
  EXPECT_EQ(half.classify({Vec3(-1), Vec3(-0.5)}), BoxState::mixed);
  EXPECT_EQ(half.classify({Vec3(-4), Vec3(-3)}), BoxState::outside);
}

}  // namespace
}  // namespace talus

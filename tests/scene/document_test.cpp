#include "talus/scene/document.h"

#include <gtest/gtest.h>

#include "talus/base/error.h"

namespace talus {
namespace {

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

constexpr std::string_view kText = R"(seed = 3
zeta = 1.0
alpha = "a \"quoted\" word"

[view]
zoom = 1e-3
list = [1, [true, 2.5], {x = 1}]

[[operation]]
type = "pile"
support = { shape = "join", parts = [
  { shape = "sphere" },
  { shape = "box" },
] }
[[operation]]
"odd key" = false
)";

TEST(Document, KeepsTheLineOfEveryValue) {
  const Value document = parse_document(kText, "scene.toml");
  EXPECT_EQ(document.find("seed")->where, "scene.toml:1");
  EXPECT_EQ(document.find("view")->find("zoom")->where, "scene.toml:6");
  const Value& second = document.find("operation")->array()->at(1);
  EXPECT_EQ(second.find("odd key")->where, "scene.toml:16");
}

TEST(Document, KeepsTheOrderOfKeys) {
  const Value document = parse_document(kText, "");
  std::vector<std::string> keys;
  for (const Member& member : *document.table()) keys.push_back(member.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"seed", "zeta", "alpha", "view", "operation"}));
}

TEST(Document, WritesWhatItReads) {
  const Value document = parse_document(kText, "");
  const std::string text = to_toml(document);
  EXPECT_EQ(parse_document(text, ""), document);
  EXPECT_EQ(to_toml(parse_document(text, "")), text);
}

TEST(Document, KeepsNumbersAndIntegersApart) {
  const Value document = parse_document("a = 1\nb = 1.0\nc = 1e300\nd = 0.1", "");
  EXPECT_EQ(to_toml(document), "a = 1\nb = 1.0\nc = 1e+300\nd = 0.1\n");
  EXPECT_FALSE(*document.find("a") == *document.find("b"));
}

TEST(Document, EscapesText) {
  const Value document{Value::Table{{"a b", {std::string("\"\\\n\t\x01\x7f\u00e9")}}}};
  EXPECT_EQ(parse_document(to_toml(document), ""), document);
}

TEST(Document, NamesTheLineOfASyntaxError) {
  EXPECT_TRUE(
      message_of([] { parse_document("seed = 1\nseed 2\n", "a.toml"); }).starts_with("a.toml:2: "));
  EXPECT_TRUE(message_of([] {
                parse_document("seed = 1\nseed = 2\n", "a.toml");
              }).starts_with("a.toml:2: "));
  EXPECT_TRUE(message_of([] { parse_document("a = [1, 2", "a.toml"); }).starts_with("a.toml:1: "));
}

TEST(Document, RefusesDates) {
  EXPECT_EQ(message_of([] { parse_document("\na = 2020-01-01", "a.toml"); }),
            "a.toml:2: dates and times have no use in a recipe; quote it as text");
}

TEST(Document, SettingsReplaceAndAdd) {
  Value document = parse_document(kText, "");
  for (const char* setting :
       {"seed=4", "operation.0.tiles.n=7", "operation.1.stone_size=5%",
        "output.formats=[\"glb\", \"ply\"]", "view.zoom = 2", "name=angel.ply"})
    apply_setting(document, setting);
  EXPECT_EQ(*document.find("seed"), (Value{std::int64_t{4}}));
  const Value::Array& operations = *document.find("operation")->array();
  EXPECT_EQ(*operations[0].find("tiles")->find("n"), (Value{std::int64_t{7}}));
  EXPECT_EQ(*operations[1].find("stone_size"), (Value{std::string("5%")}));
  EXPECT_EQ(document.find("output")->find("formats")->array()->size(), 2u);
  EXPECT_EQ(*document.find("name"), (Value{std::string("angel.ply")}));
  EXPECT_EQ(document.find("seed")->where, "--set seed=4");
  EXPECT_EQ(document.find("output")->find("formats")->array()->at(0).where,
            "--set output.formats=[\"glb\", \"ply\"]");
}

TEST(Document, SettingsNameThemselvesInErrors) {
  Value document = parse_document(kText, "");
  const auto message = [&](const char* setting) {
    return message_of([&] { apply_setting(document, setting); });
  };
  EXPECT_EQ(message("seed"), "--set seed: write path=value, for example seed=3");
  EXPECT_EQ(message("=3"), "--set =3: write path=value, for example seed=3");
  EXPECT_EQ(message("operation.2.name=x"),
            "--set operation.2.name=x: operation has no element \"2\"; it has 0 to 1");
  EXPECT_EQ(message("operation.pile=x"),
            "--set operation.pile=x: operation has no element \"pile\"; it has 0 to 1");
  EXPECT_EQ(message("seed.x=1"), "--set seed.x=1: seed is 3, which has no \"x\"");
}

TEST(Document, ASettingCannotSmuggleInOtherKeys) {
  Value document = parse_document("", "");
  apply_setting(document, "a=1\nb = 2");
  EXPECT_EQ(*document.find("a"), (Value{std::string("1\nb = 2")}));
  EXPECT_EQ(document.find("b"), nullptr);
}

}  // namespace
}  // namespace talus

#include "talus/scene/support_source.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "talus/field/formula.h"

namespace talus {
namespace {

constexpr std::string_view kSupportForms =
    "{ mesh = \"FILE\" }, { shape = \"sphere\", ... }, { formula = \"z < 1\", ... } or "
    "{ lower = \"FILE\", upper = \"FILE\" }";

constexpr std::string_view kPileForms =
    "{ mesh = \"FILE\" }, { shape = \"sphere\", ... }, { formula = \"z < 1\", ... }, "
    "{ lower = \"FILE\", upper = \"FILE\" } or the terrain's \"rocks\"";

struct RuleHelp {
  Combination::Rule rule;
  std::string_view name;
  std::string_view help;
};
constexpr std::array kRules = {
    RuleHelp{Combination::Rule::join, "join", "all that any part holds"},
    RuleHelp{Combination::Rule::subtract, "subtract", "the first part without the others"},
    RuleHelp{Combination::Rule::intersect, "intersect", "what every part holds"},
};

constexpr Field kBlendField{.name = "blend",
                            .help = "distance over which neighboring surfaces flow into each other",
                            .unit = "m",
                            .min = 0};
constexpr Field kPartsField{.name = "parts", .help = "the shapes that are combined, in order"};

// Calls `visit(P{})` for each primitive, that is each described alternative of `Shape`.
template <class Visit, class... Alternatives>
void for_each_primitive(std::variant<Alternatives...>*, Visit&& visit) {
  const auto visit_one = [&]<class P>(std::type_identity<P>) {
    if constexpr (Described<P>) visit(P{});
  };
  (visit_one(std::type_identity<Alternatives>{}), ...);
}
void for_each_primitive(auto&& visit) {
  for_each_primitive(static_cast<Shape*>(nullptr), std::forward<decltype(visit)>(visit));
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for_each_primitive([&]<class P>(P) { names.emplace_back(P::kName); });
  for (const RuleHelp& rule : kRules) names.emplace_back(rule.name);
  return names;
}

// Whether a word that names no shape was meant to: there is no such file, and it has a shape's keys
// or nearly its name.
bool is_misspelt(std::string_view text, const std::string& name,
                 std::span<const std::string> names) {
  std::error_code error;  // what cannot be looked at is refused when it is read
  if (std::filesystem::exists(text, error) || error) return false;
  return (name.size() < text.size() && text.find('=') != std::string_view::npos) ||
         is_near(name, names);
}

template <class Source>
void read_source(const Value& value, const std::string& path, Source& out, std::string_view forms) {
  std::vector<std::string_view> kinds;
  for (const std::string_view kind : {"mesh", "shape", "formula", "upper"})
    if (value.find(kind)) kinds.push_back(kind);
  if (kinds.empty())
    fail_at(value.where, path,
            fmt::format("{} is no support; write {}", value.text() ? to_text(value) : "this value",
                        forms));
  if (kinds.size() > 1)
    fail_at(value.where, path,
            fmt::format("\"{}\" and \"{}\" at once; give one of them", kinds[0], kinds[1]));
  if (kinds[0] == "mesh")
    read_value(value, path, out.template emplace<MeshSource>());
  else if (kinds[0] == "shape")
    read_value(value, path, out.template emplace<Shape>());
  else if (kinds[0] == "formula")
    read_value(value, path, out.template emplace<FormulaSource>());
  else
    read_value(value, path, out.template emplace<HeightsSource>());
}

Combination read_combination(const Value& table, const std::string& path, Combination::Rule rule) {
  const std::vector<std::string> names = {"shape", "blend", "parts"};
  detail::check_keys(table, path, names);
  Combination combination{.rule = rule};
  if (const Value* blend = table.find("blend")) {
    const std::string name = joined_path(path, "blend");
    read_value(*blend, name, combination.blend);
    if (!(combination.blend >= 0) || !std::isfinite(combination.blend))
      fail_at(blend->where, name, to_text(*blend) + " is out of range; it must be at least 0 m");
  }
  const Value* parts = table.find("parts");
  if (parts) read_value(*parts, joined_path(path, "parts"), combination.parts);
  if (combination.parts.empty())
    fail_at(table.where, path, "\"parts\" is missing or empty; give the shapes to combine");
  return combination;
}

}  // namespace

void read_value(const Value& value, const std::string& path, Shape& out) {
  if (!value.table()) fail_at(value.where, path, "no shape; write { shape = \"sphere\", ... }");
  const Value* kind = value.find("shape");
  if (!kind) fail_at(value.where, path, "\"shape\" is missing; write { shape = \"sphere\", ... }");
  std::string name;
  read_value(*kind, joined_path(path, "shape"), name);

  for (const RuleHelp& rule : kRules) {
    if (rule.name != name) continue;
    out = read_combination(value, path, rule.rule);
    return;
  }
  bool known = false;
  for_each_primitive([&]<class P>(P primitive) {
    if (P::kName != name) return;
    read_fields(value, path, primitive, std::array<std::string, 1>{"shape"});
    out = primitive;
    known = true;
  });
  if (!known)
    fail_at(kind->where, path,
            fmt::format("unknown shape \"{}\"; {}", name, suggest(name, shape_names())));
}

void read_value(const Value& value, const std::string& path, FormulaSource& out) {
  read_fields(value, path, out);
  for (const std::string_view corner : {"min", "max"})
    if (!value.find(corner))
      fail_at(value.where, path,
              fmt::format("\"{}\" is missing; write {} = [X, Y, Z], a corner of the box that the "
                          "formula is asked in",
                          corner, corner));
  try {
    FormulaSupport(out.formula, {out.min, out.max});
  } catch (const Error& error) {
    fail_at(value.find("formula")->where, joined_path(path, "formula"), error.what());
  }
}

void read_value(const Value& value, const std::string& path, HeightsSource& out) {
  read_fields(value, path, out);
  if (out.lower.empty())
    fail_at(value.where, path, "\"lower\" is missing; write lower = \"FILE\", a raster");
}

void read_value(const Value& value, const std::string& path, SupportSource& out) {
  read_source(value, path, out, kSupportForms);
}

void read_value(const Value& value, const std::string& path, PileSource& out) {
  if (value.text()) {
    read_value(value, path, out.emplace<LayerSource>().material);
    return;
  }
  read_source(value, path, out, kPileForms);
}

Value write_value(const Shape& shape) {
  Value::Table table;
  std::visit(
      [&]<class S>(const S& s) {
        if constexpr (Described<S>) {
          table = std::get<Value::Table>(write_fields(s).data);
          table.insert(table.begin(), {"shape", write_value(std::string(S::kName))});
        } else {
          const auto rule = std::find_if(kRules.begin(), kRules.end(),
                                         [&](const RuleHelp& r) { return r.rule == s.rule; });
          table.push_back({"shape", write_value(std::string(rule->name))});
          if (s.blend != 0) table.push_back({"blend", write_value(s.blend)});
          table.push_back({"parts", write_value(s.parts)});
        }
      },
      shape);
  return {table};
}

Value write_value(const SupportSource& source) {
  return std::visit([](const auto& s) { return write_value(s); }, source);
}

Value write_value(const PileSource& source) {
  return std::visit(
      []<class S>(const S& s) {
        if constexpr (std::is_same_v<S, LayerSource>)
          return write_value(s.material);
        else
          return write_value(s);
      },
      source);
}

std::string type_name(const SupportSource&) { return std::string(kSupportForms); }
std::string type_name(const PileSource&) { return std::string(kPileForms); }

Value parse_support(std::string_view text, const std::string& where) {
  Value support;
  const std::string name(text.substr(0, text.find(':')));
  const std::vector<std::string> names = shape_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    if (is_misspelt(text, name, names))
      throw usage_error(fmt::format("{}: no such file, and no shape \"{}\"; {}", where, name,
                                    suggest(name, names)));
    support.data = Value::Table{{"mesh", write_value(std::string(text))}};
  } else {
    const std::string keys(name.size() < text.size() ? text.substr(name.size() + 1) : "");
    Value document;
    try {
      document = parse_document(
          fmt::format("support = {{ shape = \"{}\"{}{} }}", name, keys.empty() ? "" : ", ", keys),
          where);
    } catch (const Error&) {
      throw usage_error(fmt::format("{}: \"{}\" cannot be read; write for example {}", where, keys,
                                    "sphere:radius=2,center=[0,0,1]"));
    }
    support = *document.find("support");
  }
  set_place(support, where);
  return support;
}

std::vector<ShapeHelp> list_shapes() {
  std::vector<ShapeHelp> shapes;
  for_each_primitive([&]<class P>(P primitive) {
    shapes.push_back({std::string(P::kName), std::string(P::kHelp), list_keys(primitive)});
  });
  for (const RuleHelp& rule : kRules)
    shapes.push_back(
        {std::string(rule.name),
         std::string(rule.help),
         {{.path = "blend",
           .type = type_name(double{}),
           .unit = std::string(kBlendField.unit),
           .allowed = detail::allowed_text(kBlendField),
           .default_value = "0.0",
           .help = std::string(kBlendField.help)},
          {.path = "parts", .type = "list of shapes", .help = std::string(kPartsField.help)}}});
  return shapes;
}

}  // namespace talus

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/base/error.h"
#include "talus/base/suggest.h"
#include "talus/field/formula_program.h"

namespace talus {
namespace {

using Op = FormulaProgram::Op;

constexpr std::size_t kLengthMax = 10'000;  // characters
constexpr int kNestingMax = 64;

struct Function {
  std::string_view name;
  Op op;
  int arguments;
};
constexpr std::array kFunctions = {
    Function{"abs", Op::abs, 1},     Function{"min", Op::min, 2},
    Function{"max", Op::max, 2},     Function{"clamp", Op::clamp, 3},
    Function{"floor", Op::floor, 1}, Function{"ceil", Op::ceil, 1},
    Function{"fract", Op::fract, 1}, Function{"mod", Op::mod, 2},
    Function{"sqrt", Op::sqrt, 1},   Function{"hypot", Op::hypot, 2},
    Function{"sin", Op::sin, 1},     Function{"cos", Op::cos, 1},
    Function{"tan", Op::tan, 1},     Function{"atan2", Op::atan2, 2},
    Function{"exp", Op::exp, 1},     Function{"log", Op::log, 1},
    Function{"pow", Op::power, 2},   Function{"mix", Op::mix, 3},
    Function{"step", Op::step, 2},   Function{"smoothstep", Op::smoothstep, 3},
    Function{"noise", Op::noise, 3}, Function{"length", Op::length, 3},
};

struct Variable {
  std::string_view name;
  FormulaProgram::Step step;
};
constexpr std::array kVariables = {
    Variable{"x", {Op::x}},
    Variable{"y", {Op::y}},
    Variable{"z", {Op::z}},
    Variable{"pi", {Op::number, std::numbers::pi}},
};

// Letters that C's locale has no say in.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

[[noreturn]] void fail(std::size_t column, const std::string& what) {
  throw usage_error(fmt::format("column {}: {}", column, what));
}

// A word, a number, a sign, or nothing at the end.
struct Token {
  enum class Kind { end, number, word, sign };
  Kind kind = Kind::end;
  std::string_view text;
  double number = 0;
  std::size_t column = 1;
};

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) { advance(); }

  const Token& next() const { return next_; }
  Token take() {
    const Token token = next_;
    advance();
    return token;
  }

 private:
  void advance() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n'))
      ++at_;
    next_ = {.column = at_ + 1};
    if (at_ == text_.size()) return;
    const char c = text_[at_];
    std::size_t size = 1;
    if (is_digit(c) || c == '.') {
      size = read_number();
    } else if (is_letter(c)) {
      next_.kind = Token::Kind::word;
      while (at_ + size < text_.size() &&
             (is_letter(text_[at_ + size]) || is_digit(text_[at_ + size])))
        ++size;
    } else if (std::string_view("+-*/^(),<>").find(c) != std::string_view::npos) {
      next_.kind = Token::Kind::sign;
      const bool or_equal = (c == '<' || c == '>') && text_.substr(at_ + 1).starts_with('=');
      if (or_equal) size = 2;
    } else {
      const bool shown = c > ' ' && c <= '~';
      fail(at_ + 1, shown ? fmt::format("\"{}\" has no meaning in a formula", c)
                          : "a character that has no meaning in a formula");
    }
    next_.text = text_.substr(at_, size);
    at_ += size;
  }

  std::size_t read_number() {
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), next_.number);
    if (error != std::errc{}) fail(at_ + 1, "a number that cannot be read");
    next_.kind = Token::Kind::number;
    return static_cast<std::size_t>(end - begin);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Token next_;
};

// By recursive descent, one function for each strength of binding, the weakest first. Each appends
// the steps of what it reads and says what their value is.
class Parser {
 public:
  explicit Parser(std::string_view text) : lexer_(text) {}

  FormulaProgram parse() {
    const Token begin = lexer_.next();
    if (begin.kind == Token::Kind::end) fail(1, "the formula is empty; write for example z < 1");
    if (disjunction() == Type::number)
      fail(begin.column, "the formula is a number; compare it, for example with \"< 0\"");
    if (lexer_.next().kind != Token::Kind::end)
      fail(lexer_.next().column,
           fmt::format("\"{}\" does not belong here; an operator or the end should",
                       lexer_.next().text));
    return std::move(program_);
  }

 private:
  enum class Type { number, truth };

  bool is_next(std::string_view text) const { return lexer_.next().text == text; }
  std::optional<Token> take_if(std::string_view text) {
    if (!is_next(text)) return {};
    return lexer_.take();
  }

  // `arguments` values become one.
  void append(FormulaProgram::Step step, int arguments, std::size_t column) {
    waiting_ += 1 - arguments;
    if (waiting_ > FormulaProgram::kDepthMax) fail_deep(column);
    program_.depth = std::max(program_.depth, waiting_);
    program_.steps.push_back(step);
  }
  [[noreturn]] static void fail_deep(std::size_t column) {
    fail(column, "the formula is nested too deeply; shorten it");
  }

  void want(Type wanted, Type found, std::size_t column) {
    if (wanted == found) return;
    fail(column, wanted == Type::number ? "a condition where a number should be"
                                        : "a number where a condition should be");
  }
  void want_sign(std::string_view sign, std::string_view why) {
    if (!take_if(sign)) fail(lexer_.next().column, fmt::format("\"{}\" is missing {}", sign, why));
  }

  // Operands of one kind with operators of equal strength between them, from the left.
  template <std::size_t N>
  Type chain(Type kind, Type (Parser::*read)(),
             const std::array<std::pair<std::string_view, Op>, N>& operators) {
    std::size_t column = lexer_.next().column;
    const Type first = (this->*read)();
    for (;;) {
      const auto found = std::find_if(operators.begin(), operators.end(),
                                      [&](const auto& o) { return is_next(o.first); });
      if (found == operators.end()) return first;
      want(kind, first, column);
      lexer_.take();
      column = lexer_.next().column;
      want(kind, (this->*read)(), column);
      append({found->second}, 2, column);
    }
  }

  Type disjunction() {
    if (++nesting_ > kNestingMax) fail_deep(lexer_.next().column);
    const Type type = chain<1>(Type::truth, &Parser::conjunction, {{{"or", Op::either}}});
    --nesting_;
    return type;
  }
  Type conjunction() { return chain<1>(Type::truth, &Parser::negation, {{{"and", Op::both}}}); }

  Type negation() {
    bool negated = false;
    std::optional<Token> first;
    while (const auto word = take_if("not")) {
      first = word;
      negated = !negated;
    }
    const std::size_t column = lexer_.next().column;
    const Type type = comparison();
    if (first) want(Type::truth, type, column);
    if (negated) append({Op::negation}, 1, column);
    return type;
  }

  Type comparison() {
    std::size_t column = lexer_.next().column;
    const Type type = sum();
    if (!is_comparison()) return type;
    want(Type::number, type, column);
    const Token sign = lexer_.take();
    // a > b is -a < -b.
    const bool greater = sign.text[0] == '>';
    if (greater) append({Op::negate}, 1, column);
    column = lexer_.next().column;
    want(Type::number, sum(), column);
    if (greater) append({Op::negate}, 1, column);
    append({sign.text.size() == 2 ? Op::less_equal : Op::less}, 2, sign.column);
    if (is_comparison())
      fail(lexer_.next().column, "comparisons do not chain; write a < b and b < c");
    return Type::truth;
  }
  bool is_comparison() const {
    return is_next("<") || is_next(">") || is_next("<=") || is_next(">=");
  }

  Type sum() {
    return chain<2>(Type::number, &Parser::product, {{{"+", Op::add}, {"-", Op::subtract}}});
  }
  Type product() {
    return chain<2>(Type::number, &Parser::signed_power,
                    {{{"*", Op::multiply}, {"/", Op::divide}}});
  }

  // -a^b is -(a^b); a^b^c is a^(b^c); a^-b is a^(-b).
  Type signed_power() {
    if (++nesting_ > kNestingMax) fail_deep(lexer_.next().column);
    const auto minus = take_if("-");
    const std::size_t column = lexer_.next().column;
    const Type type = minus ? signed_power() : operand();
    if (minus) {
      want(Type::number, type, column);
      append({Op::negate}, 1, column);
    } else if (take_if("^")) {
      want(Type::number, type, column);
      const std::size_t exponent = lexer_.next().column;
      want(Type::number, signed_power(), exponent);
      append({Op::power}, 2, exponent);
    }
    --nesting_;
    return type;
  }

  Type operand() {
    const Token token = lexer_.take();
    if (token.kind == Token::Kind::number) {
      append({Op::number, token.number}, 0, token.column);
      return Type::number;
    }
    if (token.text == "(") {
      const Type type = disjunction();
      want_sign(")", fmt::format("for the \"(\" in column {}", token.column));
      return type;
    }
    if (token.kind == Token::Kind::word) return name(token);
    fail(token.column, token.kind == Token::Kind::end
                           ? "the formula ends where a value should be"
                           : fmt::format("\"{}\" where a value should be", token.text));
  }

  Type name(const Token& word) {
    for (const Variable& variable : kVariables)
      if (variable.name == word.text) {
        append(variable.step, 0, word.column);
        return Type::number;
      }
    for (const Function& function : kFunctions)
      if (function.name == word.text) return call(function, word);
    std::vector<std::string> names;
    for (const Variable& variable : kVariables) names.emplace_back(variable.name);
    for (const Function& function : kFunctions) names.emplace_back(function.name);
    fail(word.column, fmt::format("unknown name \"{}\"; {}", word.text, suggest(word.text, names)));
  }

  Type call(const Function& function, const Token& word) {
    want_sign("(", fmt::format("behind \"{}\"", function.name));
    const std::string count = fmt::format("{} takes {} argument{}", function.name,
                                          function.arguments, function.arguments == 1 ? "" : "s");
    for (int i = 0; i < function.arguments; ++i) {
      if (i > 0) want_sign(",", fmt::format("here: {}", count));
      const std::size_t column = lexer_.next().column;
      want(Type::number, disjunction(), column);
    }
    want_sign(")", fmt::format("here: {}", count));
    append({function.op}, function.arguments, word.column);
    return Type::number;
  }

  Lexer lexer_;
  FormulaProgram program_;
  int nesting_ = 0;
  int waiting_ = 0;
};

}  // namespace

FormulaProgram parse_formula(std::string_view text) {
  if (text.size() > kLengthMax)
    throw usage_error(
        fmt::format("the formula has {} characters; at most {} are read", text.size(), kLengthMax));
  return Parser(text).parse();
}

}  // namespace talus

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>
#include <utility>

#include "expression/expression.h"
#include "expression/functions.h"
#include "files/printable.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kDeepest = 100;  // rules within each other: two for a pair of parentheses

using Kind = ExpressionStep::Kind;

constexpr std::pair<const char*, FormInput> kInputs[] = {{"A", FormInput::sky_view_factor},
                                                         {"alpha", FormInput::ambient_occlusion},
                                                         {"n", FormInput::seen},
                                                         {"rho", FormInput::albedo},
                                                         {"albedo", FormInput::albedo}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_constant_name(const std::string& name) { return std::all_of(name.begin() + 1, name.end(), is_digit); }

/// The index of the function of that name that is written with parentheses.
std::optional<std::size_t> find_function(const std::string& name) {
  const std::span<const FormulaFunction> functions = formula_functions();
  for (std::size_t i = kNegation + 1; i < functions.size(); ++i) {
    if (name == functions[i].name || (functions[i].other_name && name == functions[i].other_name)) return i;
  }
  return std::nullopt;
}

/// By recursive descent; each rule appends the steps of what it has read.
class Parser {
 public:
  Parser(const std::string& text, std::size_t begin) : text_(text), at_(begin) { skip_spaces(); }

  Expression parse() {
    const std::size_t begin = at_;
    sum();
    if (at_ < text_.size()) throw error(std::string("'") + text_[at_] + "' is not expected");
    expression_.text = text_.substr(begin, text_.find_last_not_of(" \t") + 1 - begin);
    return std::move(expression_);
  }

 private:
  UsageError error(const std::string& fault) const { return error_at(at_, fault); }

  UsageError error_at(std::size_t place, const std::string& fault) const {
    return UsageError("form", printable("'" + text_ + "'"),
                      "column " + std::to_string(place + 1) + ": " + printable(fault));
  }

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  /// Whether that is what comes next; it is passed then.
  bool take(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    skip_spaces();
    return true;
  }

  void expect(char c) {
    if (!take(c)) throw error(std::string("a '") + c + "' is missing");
  }

  void add(Kind kind, std::size_t index, double number = 0) {
    if (expression_.steps.size() == kMostSteps)
      throw error("more than " + std::to_string(kMostSteps) + " steps");
    expression_.steps.push_back({kind, number, index});
  }

  /// Of `operators`, two characters, the one that comes next.
  std::optional<std::size_t> take_operator(const char* operators, std::size_t first_index) {
    if (take(operators[0])) return first_index;
    if (take(operators[1])) return first_index + 1;
    return std::nullopt;
  }

  void sum() {
    if (++depth_ > kDeepest) throw error("nested too deeply");
    product();
    while (const auto function = take_operator("+-", 0)) {
      product();
      add(Kind::function, *function);
    }
    --depth_;
  }

  void product() {
    signed_value();
    while (const auto function = take_operator("*/", 2)) {
      signed_value();
      add(Kind::function, *function);
    }
  }

  void signed_value() {
    if (++depth_ > kDeepest) throw error("nested too deeply");
    if (take('-')) {
      signed_value();
      add(Kind::function, kNegation);
    } else if (take('+')) {
      signed_value();
    } else {
      power();
    }
    --depth_;
  }

  void power() {
    value();
    if (!take('^')) return;
    signed_value();
    add(Kind::function, kPower);
  }

  void value() {
    skip_spaces();
    if (at_ >= text_.size()) throw error("the formula ends where a value must stand");
    if (take('(')) {
      sum();
      expect(')');
    } else if (is_digit(text_[at_]) || text_[at_] == '.') {
      number();
    } else if (is_letter(text_[at_])) {
      name();
    } else {
      throw error(std::string("'") + text_[at_] + "' stands where a value must");
    }
  }

  void number() {
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto [stop, fault] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (fault != std::errc()) throw error("this is no number");
    at_ += static_cast<std::size_t>(stop - begin);
    if (at_ < text_.size() && (text_[at_] == 'f' || text_[at_] == 'F')) ++at_;  // as shaders write it
    if (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '.'))
      throw error("an operator is missing after a number");
    add(Kind::number, 0, value);
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_')) ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    if (take('(')) {
      call(name, begin);
      return;
    }
    for (const auto& [known, input] : kInputs) {
      if (name == known) return add(Kind::input, static_cast<std::size_t>(input));
    }
    if (name == "pi") return add(Kind::number, 0, std::numbers::pi);
    if (find_function(name)) throw error("'" + name + "' is a function: a '(' is missing");
    if (!is_constant_name(name))
      throw error_at(begin,
                     "'" + name +
                         "' is not known: A, alpha, n and rho are, and constants to be fitted, which are "
                         "a letter, alone or with digits (k, c2)");
    std::vector<std::string>& constants = expression_.constants;
    auto found = std::find(constants.begin(), constants.end(), name);
    if (found == constants.end()) found = constants.insert(found, name);
    add(Kind::constant, static_cast<std::size_t>(found - constants.begin()));
  }

  void call(const std::string& name, std::size_t begin) {
    const std::optional<std::size_t> function = find_function(name);
    if (!function) throw error_at(begin, "there is no function '" + name + "'");
    std::size_t count = 0;
    do {
      sum();
      ++count;
    } while (take(','));
    expect(')');
    const std::size_t wanted = formula_functions()[*function].arguments;
    if (count != wanted)
      throw error_at(begin, name + " takes " + std::to_string(wanted) +
                                (wanted == 1 ? " argument, not " : " arguments, not ") +
                                std::to_string(count));
    add(Kind::function, *function);
  }

  const std::string& text_;
  std::size_t at_;
  int depth_ = 0;
  Expression expression_;
};

}  // namespace

Expression parse_expression(const std::string& text, std::size_t begin) {
  return Parser(text, begin).parse();
}

}  // namespace heightlight

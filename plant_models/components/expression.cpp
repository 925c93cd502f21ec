#include "plant_models/components/expression.h"

#include <muParser.h>

#include <array>
#include <cmath>
#include <limits>

#include "plant_models/components/component_reader.h"

namespace stepwright::components {

struct Expression::State {
  mu::Parser parser;
};

namespace {

double clamp_function(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}

std::vector<std::string> names_of(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& variable : variables) names.push_back(variable.name);
  return names;
}

// Positive, all different, the same every time.
double sample(std::size_t variable, std::size_t round) {
  const double x = std::fmod(
      0.7548776662 * static_cast<double>(variable + 1) + 0.5698402910 * static_cast<double>(round + 1), 1.0);
  return 0.25 + 1.5 * x;
}

}  // namespace

Expression::Expression(std::unique_ptr<State> state) : state_(std::move(state)) {}
Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

result::Result<Expression> Expression::create(const std::string& text, const std::vector<Variable>& variables,
                                              const result::Location& where) {
  auto state = std::make_unique<State>();
  try {
    state->parser.DefineFun("clamp", clamp_function);
    for (const Variable& variable : variables) state->parser.DefineVar(variable.name, variable.place);
    state->parser.SetExpr(text);
    (void)state->parser.Eval();
  } catch (const mu::Parser::exception_type& problem) {
    const std::string token = problem.GetToken();
    const bool unknown = problem.GetCode() == mu::ecUNASSIGNABLE_TOKEN;
    return result::fail("C0349", where,
                        unknown ? "'" + token + "' in \"" + text + "\" is nothing that is known here"
                                : "\"" + text + "\" cannot be read: " + problem.GetMsg(),
                        unknown ? meant_or(token, names_of(variables))
                                : "at character " + std::to_string(problem.GetPos() + 1));
  }
  return Expression(std::move(state));
}

double Expression::value() const {
  try {
    return state_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<std::string> Expression::reads() const {
  std::vector<std::string> names;
  for (const auto& [name, place] : state_->parser.GetUsedVar()) names.push_back(name);
  return names;
}

result::Result<void> check_dimension(const Expression& expression, const std::vector<Variable>& variables,
                                     const Dimension& wanted, const std::string& what,
                                     const result::Location& where) {
  constexpr std::size_t kRounds = 6;
  constexpr std::array<double, 2> kScales = {2.0, 3.0};
  constexpr double kNear = 1e-6;
  Dimension found;
  bool mixed = false;
  bool seen = false;
  for (std::size_t base = 0; base < found.exponents.size(); ++base) {
    bool first = true;
    for (std::size_t round = 0; round < kRounds; ++round) {
      for (const double scale : kScales) {
        for (std::size_t i = 0; i < variables.size(); ++i) *variables[i].place = sample(i, round);
        const double before = expression.value();
        for (const Variable& variable : variables)
          *variable.place *= std::pow(scale, variable.dimension.exponents[base]);
        const double after = expression.value();
        // Zero has every unit.
        if (before == 0.0 && after == 0.0) continue;
        if (!std::isfinite(before) || !std::isfinite(after)) continue;
        seen = true;
        const double exponent = after / before > 0.0 ? std::log(after / before) / std::log(scale) : 99.5;
        const double whole = std::round(exponent);
        mixed = mixed || std::abs(exponent - whole) > kNear || std::abs(whole) > 20.0;
        if (!first) mixed = mixed || static_cast<double>(found.exponents[base]) != whole;
        if (!mixed) found.exponents[base] = static_cast<std::int8_t>(whole);
        first = false;
      }
    }
  }
  if (mixed)
    return result::fail(
        "C0341", where,
        what + " adds or compares figures of different units, or has a number that should have one",
        "a constant with a unit is a parameter");
  if (seen && found != wanted)
    return result::fail("C0341", where,
                        "the unit of " + what + " does not fit: " + to_string(found) + " where " +
                            to_string(wanted) + " is wanted",
                        "a constant with a unit is a parameter");
  return {};
}

}  // namespace stepwright::components

// Standard functions (IEC 61131-3, 6.6.2.5) in an expression that is watched.

#include <algorithm>
#include <utility>

#include "hmi_web/monitor/evaluator.h"
#include "ladder/semantics/constants/common_type.h"
#include "ladder/semantics/constants/constant_conversion.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::monitor {

using semantics::StandardFunction;
using semantics::Type;
using syntax::Operator;
using Inputs = std::span<const Value>;

namespace {

template <typename Meaning>
using Named = std::pair<std::string_view, Meaning>;

constexpr Named<Operator> kFolds[] = {{"AND", Operator::And},
                                      {"OR", Operator::Or},
                                      {"XOR", Operator::Xor},
                                      {"ADD", Operator::Add},
                                      {"MUL", Operator::Multiply}};
constexpr Named<Operator> kPairs[] = {{"SUB", Operator::Subtract},
                                      {"DIV", Operator::Divide},
                                      {"MOD", Operator::Modulo},
                                      {"EXPT", Operator::Power}};
constexpr Named<Operator> kChains[] = {{"GT", Operator::Greater}, {"GE", Operator::GreaterEqual},
                                       {"EQ", Operator::Equal},   {"LE", Operator::LessEqual},
                                       {"LT", Operator::Less},    {"NE", Operator::NotEqual}};
constexpr Named<StandardFunction> kFunctions[] = {
    {"ABS", StandardFunction::Abs}, {"MIN", StandardFunction::Min}, {"MAX", StandardFunction::Max}};
constexpr Named<StandardFunction> kRealFunctions[] = {
    {"SQRT", StandardFunction::Sqrt}, {"LN", StandardFunction::Ln},     {"LOG", StandardFunction::Log},
    {"EXP", StandardFunction::Exp},   {"SIN", StandardFunction::Sin},   {"COS", StandardFunction::Cos},
    {"TAN", StandardFunction::Tan},   {"ASIN", StandardFunction::Asin}, {"ACOS", StandardFunction::Acos},
    {"ATAN", StandardFunction::Atan}};

template <typename Meaning, std::size_t Size>
std::optional<Meaning> find(const Named<Meaning> (&table)[Size], std::string_view name) {
  for (const auto& [known, meaning] : table)
    if (known == name) return meaning;
  return std::nullopt;
}

}  // namespace

Value Evaluator::call(std::string_view written, Inputs inputs) const {
  const std::string name = naming::upper(written);
  if (inputs.empty()) return std::nullopt;
  if (const auto op = find(kFolds, name)) return fold(*op, inputs);
  if (const auto op = find(kChains, name)) return chain(*op, inputs);
  if (const auto which = find(kFunctions, name)) return function(*which, inputs);
  if (inputs.size() == 1) {
    if (const auto which = find(kRealFunctions, name)) return real_function(*which, inputs[0]);
    if (name == "NOT") return invert(inputs[0]);
    if (name == "MOVE") return inputs[0];
    return converted(name, inputs[0]);
  }
  if (inputs.size() == 2) {
    const auto op = find(kPairs, name);
    return op ? combine(*op, inputs[0], inputs[1]) : std::nullopt;
  }
  if (inputs.size() != 3) return std::nullopt;
  if (name == "SEL" && is_bool(inputs[0])) return is_true(inputs[0]) ? inputs[2] : inputs[1];
  if (name != "LIMIT") return std::nullopt;
  const Value raised[] = {function(StandardFunction::Max, inputs.first(2)), inputs[2]};
  return function(StandardFunction::Min, raised);
}

Value Evaluator::fold(Operator op, Inputs inputs) const {
  Value result = inputs[0];
  for (const Value& each : inputs.subspan(1)) result = combine(op, result, each);
  return result;
}

Value Evaluator::chain(Operator op, Inputs inputs) const {
  Value result = boolean(true);
  for (std::size_t i = 1; i < inputs.size(); ++i)
    result = combine(Operator::And, result, combine(op, inputs[i - 1], inputs[i]));
  return result;
}

// Of numbers in the type that holds them all.
Value Evaluator::function(StandardFunction which, Inputs inputs) const {
  const Known* first = inputs[0] ? &*inputs[0] : nullptr;
  Known widest = first != nullptr ? *first : Known{};
  for (const Value& each : inputs) {
    if (first == nullptr || !each || is_bool(each)) return std::nullopt;
    widest.type =
        semantics::common_type(types_, {*widest.type, widest.constant}, {*each->type, each->constant});
    if (widest.type == nullptr) return std::nullopt;
  }
  std::vector<semantics::Constant> operands;
  for (const Value& each : inputs) {
    Value same = to_type(*each, widest.type);
    if (!same) return std::nullopt;
    operands.push_back(std::move(same->constant));
  }
  auto result = semantics::evaluate(which, operands, *widest.type, *widest.type);
  return result ? Value(Known{widest.type, std::move(*result)}) : std::nullopt;
}

Value Evaluator::real_function(StandardFunction which, const Value& input) const {
  if (!input || !input->type->is_number()) return std::nullopt;
  const bool narrow = input->type->is(bytecode::ElementaryType::Real);
  const Type* type =
      types_.elementary(narrow ? bytecode::ElementaryType::Real : bytecode::ElementaryType::Lreal);
  const Value real = to_type(*input, type);
  if (!real) return std::nullopt;
  auto result = semantics::evaluate(which, std::span(&real->constant, 1), *type, *type);
  return result ? Value(Known{type, std::move(*result)}) : std::nullopt;
}

// INT_TO_REAL, TO_REAL.
Value Evaluator::converted(std::string_view name, const Value& input) const {
  const auto to = name.rfind("TO_");
  if (!input || to == std::string_view::npos || (to > 0 && name[to - 1] != '_')) return std::nullopt;
  bytecode::ElementaryType target{};
  bytecode::ElementaryType source{};
  if (!semantics::elementary_from(std::string(name.substr(to + 3)), target)) return std::nullopt;
  Value from = input;
  if (to > 0) {
    if (!semantics::elementary_from(std::string(name.substr(0, to - 1)), source)) return std::nullopt;
    from = to_type(*input, types_.elementary(source));
  }
  return from ? to_type(*from, types_.elementary(target)) : std::nullopt;
}

}  // namespace stepwright::monitor

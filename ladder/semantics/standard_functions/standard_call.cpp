// Standard functions (IEC 61131-3, 6.6.2.5): which one a name means, and its arguments.

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "ladder/semantics/constants/constant_function.h"
#include "ladder/semantics/standard_functions/standard_analyzer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;

namespace {

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> list;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    list.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return list;
}

bool is_extensible(std::string_view formals) {
  return !formals.empty() && formals.back() == '+';
}

// "IN1+" -> "IN", 1
struct Series {
  std::string_view stem;
  std::size_t first = 0;
};

Series series_of(std::string_view last) {
  last.remove_suffix(1);
  return {last.substr(0, last.size() - 1), static_cast<std::size_t>(last.back() - '0')};
}

constexpr std::size_t kMostArguments = 1000;

}  // namespace

const StandardAnalyzer::Entry* StandardAnalyzer::find(std::string_view folded) {
  for (const auto family : {numeric_entries(), operator_entries(), selection_entries(), bit_entries(),
                            time_entries(), text_entries()})
    for (const Entry& each : family)
      if (each.name == folded) return &each;
  return nullptr;
}

void StandardAnalyzer::add_names(std::vector<std::string_view>& names) {
  for (const auto family : {numeric_entries(), operator_entries(), selection_entries(), bit_entries(),
                            time_entries(), text_entries()})
    for (const Entry& each : family)
      if (each.name.front() != '_') names.push_back(each.name);
}

ValuePtr StandardAnalyzer::call(const Expression& call, const std::string& folded, bool& known) {
  known = true;
  if (const Entry* entry = find(folded)) {
    auto values = arguments(call, entry->formals, entry->least);
    return values ? (this->*entry->analyse)(call, std::move(*values), entry->which) : nullptr;
  }
  // "ADD_INT": the function for one type (6.6.1.7.3).
  const std::size_t last = folded.rfind('_');
  const Type* type =
      last == std::string::npos ? nullptr : e_.explicit_conversions().named_type(folded.substr(last + 1));
  const Entry* entry = type == nullptr ? nullptr : find(std::string_view(folded).substr(0, last));
  if (entry != nullptr && entry->typed_count > 0) return typed_call(call, *entry, type);
  known = false;
  return nullptr;
}

ValuePtr StandardAnalyzer::typed_call(const Expression& call, const Entry& entry, const Type* type) {
  auto values = arguments(call, entry.formals, entry.least);
  if (!values) return nullptr;
  const std::size_t end = std::min(values->size(), entry.typed_first + entry.typed_count);
  for (std::size_t i = entry.typed_first; i < end; ++i) {
    const Position where = (*values)[i]->where;
    (*values)[i] = e_.conversions().convert(std::move((*values)[i]), type, where);
    if (!(*values)[i]) return nullptr;
  }
  return (this->*entry.analyse)(call, std::move(*values), entry.which);
}

void StandardAnalyzer::wrong_count(const Expression& call, std::string_view formals, std::size_t least) {
  const std::string count = std::to_string(least) + (is_extensible(formals) ? " or more" : "");
  a_.error(code::kArgumentCount, call.where,
           quote(call.name.text) + " takes " + count + (least == 1 ? " argument" : " arguments") +
               ", found " + std::to_string(call.arguments.size()),
           formals.empty() ? "" : "its parameters are " + std::string(formals));
}

// Which parameter a name means; `count` after a report.
std::size_t StandardAnalyzer::parameter_index(const syntax::Name& formal, std::string_view formals,
                                              std::size_t count) {
  const std::string& wanted = a_.names.folded(formal.id);
  std::vector<std::string_view> known = words(formals);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == wanted) return i;
  if (is_extensible(formals)) {
    const Series series = series_of(known.back());
    std::size_t number = 0;
    const char* begin = wanted.data() + std::min(series.stem.size(), wanted.size());
    const char* end = wanted.data() + wanted.size();
    const auto parsed = std::from_chars(begin, end, number);
    const bool counts = wanted.rfind(series.stem, 0) == 0 && parsed.ec == std::errc() && parsed.ptr == end;
    if (counts && number >= series.first && number - series.first + known.size() - 1 < count)
      return number - series.first + known.size() - 1;
    known.back().remove_suffix(1);
  }
  a_.error(code::kUnknownParameter, formal.where, "there is no parameter " + quote(formal.text) + " here",
           known.empty() ? "" : source::did_you_mean(wanted, known));
  return count;
}

std::optional<StandardAnalyzer::Values> StandardAnalyzer::arguments(const Expression& call,
                                                                    std::string_view formals,
                                                                    std::size_t least) {
  const std::size_t count = call.arguments.size();
  const std::size_t most = is_extensible(formals) ? kMostArguments : least;
  if (count < least || count > most) {
    wrong_count(call, formals, least);
    return std::nullopt;
  }
  Values values(count);
  bool sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Argument& argument = call.arguments[i];
    std::size_t target = i;
    if (argument.formal) {
      target = parameter_index(*argument.formal, formals, count);
      if (target < count && argument.is_output) {
        a_.error(code::kUnknownParameter, argument.formal->where,
                 quote(argument.formal->text) + " is no output: write it with ':='");
        target = count;
      }
    }
    ValuePtr value = argument.value ? e_.value(*argument.value) : nullptr;
    sound = sound && target < count && value;
    if (target >= count) continue;
    if (values[target]) {
      a_.error(code::kDuplicateArgument, argument.value->where, "the argument is given twice");
      sound = false;
    }
    values[target] = std::move(value);
  }
  if (!sound) return std::nullopt;
  return values;
}

const Type* StandardAnalyzer::unify(Values& values, std::size_t first, Position where) {
  // Literals adapt to what has a type, so they are looked at last.
  std::size_t model = first;
  while (model + 1 < values.size() && values[model]->type->is_literal()) ++model;
  if (values[model]->type->is_literal()) model = first;
  const Type* common = values[model]->type;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = first; i < values.size(); ++i) {
      Value stand_in;
      stand_in.type = common;
      stand_in.adapts = common == values[model]->type && values[model]->adapts;
      if (common->is_literal()) stand_in.constant = values[model]->constant;
      const Type* wider = e_.operators().common_type(stand_in, *values[i]);
      if (wider == nullptr) {
        const Type& other = *values[i]->type;
        const bool is_wider = e_.conversions().bits().exchanges_bits(*common, other);
        e_.conversions().mismatch(is_wider ? *common : other, is_wider ? other : *common, values[i]->where);
        return nullptr;
      }
      common = wider;
    }
  }
  for (std::size_t i = first; i < values.size(); ++i) {
    if (values[i]->type == common) continue;
    values[i] = e_.conversions().convert(std::move(values[i]), common, where);
    if (!values[i]) return nullptr;
  }
  return common;
}

ValuePtr StandardAnalyzer::bounded(ValuePtr value, __int128 low, __int128 high) {
  const Type* type = value->type;
  const Position where = value->where;
  const auto cut = [&](StandardFunction function, __int128 bound) {
    Values pair;
    pair.push_back(std::move(value));
    pair.push_back(make_constant({bound}, type, where));
    value = make_standard(function, type, std::move(pair), where);
  };
  cut(StandardFunction::Min, high);
  if (!type->is_unsigned()) cut(StandardFunction::Max, low);
  return value;
}

ValuePtr StandardAnalyzer::as_dint(ValuePtr value, __int128 low, __int128 high) {
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  const Position where = value->where;
  const bool fits = !value->type->is_integer() || value->type->is_literal() || widens(*value->type, *dint);
  if (fits) return e_.conversions().convert(std::move(value), dint, where);
  return convert_exactly(bounded(std::move(value), low, high), dint);
}

ValuePtr StandardAnalyzer::wrong_operand(const Expression& call, const Type& type, std::string hint) {
  a_.error(code::kBadOperand, call.where, quote(call.name.text) + " cannot be applied to " + type.name,
           std::move(hint));
  return nullptr;
}

}  // namespace stepwright::semantics::internal

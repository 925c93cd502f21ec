#include "hmi_web/screens/part_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_web/screens/codes.h"
#include "runtime/bytecode/reader/parse_string.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/bytecode/whole_number.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::screens {
namespace {

using bytecode::ElementaryType;
using drawing::Part;
using drawing::PartKind;

// Of a number that people set.
struct Limits {
  double least = 0;
  double most = 0;
};

// What a set point or a slider can write at most: a TIME in seconds. Nothing: no number.
std::optional<Limits> limits_of(const reader::Variable& variable) {
  if (variable.enumerators != nullptr && !variable.enumerators->empty())
    return Limits{static_cast<double>(variable.enumerators->begin()->first),
                  static_cast<double>(variable.enumerators->rbegin()->first)};
  switch (variable.type) {
    case ElementaryType::Real:
      return Limits{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    case ElementaryType::Lreal:
      return Limits{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    case ElementaryType::Time: {
      constexpr double kMost = static_cast<double>(std::numeric_limits<std::int64_t>::max()) / 1e9;
      return Limits{-kMost, kMost};
    }
    default:
      break;
  }
  if (!bytecode::is_whole_number(variable.type)) return std::nullopt;
  const int bits = 8 * static_cast<int>(bytecode::size_of(bytecode::mem_type(variable.type)));
  if (bytecode::is_unsigned(variable.type)) return Limits{0, std::ldexp(1.0, bits) - 1};
  return Limits{-std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1) - 1};
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

std::string type_of(const reader::Variable& variable) {
  return bytecode::name_of(variable.type);
}

// The nearest name of an enumeration, in any case; empty: none is near.
std::string nearest_value(const reader::Variable& variable, std::string_view literal) {
  if (variable.enumerators == nullptr) return {};
  std::vector<std::string> folded;
  std::vector<std::string> names;
  for (const auto& [number, name] : *variable.enumerators) {
    folded.push_back(naming::upper(name));
    names.push_back(name);
  }
  const std::string wanted = naming::upper(std::string(literal.substr(literal.find('#') + 1)));
  const std::string* const found = result::closest(wanted, folded, (wanted.size() + 2) / 3);
  return found == nullptr ? std::string() : names[static_cast<std::size_t>(found - folded.data())];
}

class PartCheck {
 public:
  explicit PartCheck(const reader::ProgramInfo& info) : info_(info) {}

  void check(const Part& part) {
    part_ = &part;
    if (const auto written = writable(part.write)) check_values(*written);
    if (part.stop.empty()) return;
    if (const auto stopped = writable(part.stop)) check_literal(*stopped, "TRUE");
  }

  result::Diagnostics take() { return std::move(problems_); }

 private:
  // "the set point 'level' ..."
  void tell(const std::string& what, std::string hint) {
    problems_.push_back({kPartNeverWrites, result::Severity::Warning, part_->where,
                         std::string("the ") + word_of(part_->kind) + " '" + part_->key + "' " + what,
                         std::move(hint)});
  }

  // Nothing: there is no such variable, or nobody can write it.
  std::optional<reader::NamedVariable> writable(const std::string& name) {
    auto found = reader::resolve_name(info_, name);
    if (!found) return std::nullopt;
    const reader::Tag* const tag = info_.find_tag(found->name);
    if (tag != nullptr && (tag->flags & bytecode::kSymbolConstant) != 0) {
      tell("writes " + found->name + ", which is a constant", "a variable without CONSTANT can be written");
      return std::nullopt;
    }
    if (found->variable.address < info_.sizes().input_bytes) {
      tell("writes " + found->name + ", which is an input: every scan reads it anew",
           "a variable of the program that stands beside the input can be written");
      return std::nullopt;
    }
    return *std::move(found);
  }

  void check_values(const reader::NamedVariable& written) {
    switch (part_->kind) {
      case PartKind::Button:
        return check_literal(written, part_->value);
      case PartKind::Switch:
      case PartKind::StartStop:
        return check_truth(written);
      case PartKind::Choice:
        for (const auto& [literal, name] : part_->values) check_literal(written, literal);
        return;
      default:
        return check_range(written);
    }
  }

  void check_truth(const reader::NamedVariable& written) {
    if (written.variable.type == ElementaryType::Bool) return;
    tell("writes TRUE and FALSE, and " + written.name + " is of the type " + type_of(written.variable),
         "a BOOL, or another part: a button or a choice for single values, a set point for numbers");
  }

  void check_literal(const reader::NamedVariable& written, const std::string& literal) {
    const reader::Variable& variable = written.variable;
    if (bytecode::is_string(variable.type)) {
      if (const auto text = reader::parse_string(variable, literal); !text)
        tell("cannot write " + literal + " to " + written.name + ": " + text.error().front().message,
             text.error().front().hint);
      return;
    }
    const auto value = reader::parse_value(variable, literal);
    if (!value) {
      const result::Diagnostic& why = value.error().front();
      const std::string meant = nearest_value(variable, literal);
      return tell("cannot write " + literal + " to " + written.name + ": " + why.message,
                  meant.empty() ? why.hint : "did you mean '" + meant + "'?");
    }
    if (variable.enumerators == nullptr || variable.enumerators->empty()) return;
    const std::vector<std::byte> image = image_of(variable, *value);
    const auto number = static_cast<std::int64_t>(reader::read_number(at_front(variable), image));
    if (variable.enumerators->contains(number)) return;
    std::string names;
    for (const auto& [each, name] : *variable.enumerators) names += (names.empty() ? "" : " ") + name;
    tell("writes " + literal + " to " + written.name + ", which has no such value",
         "its values are " + names);
  }

  static reader::Variable at_front(reader::Variable variable) {
    variable.address = 0;
    return variable;
  }
  static std::vector<std::byte> image_of(const reader::Variable& variable, std::uint64_t value) {
    std::vector<std::byte> image;
    for (std::uint32_t i = 0; i < bytecode::size_of(bytecode::mem_type(variable.type)); ++i)
      image.push_back(static_cast<std::byte>(value >> 8 * i));
    return image;
  }

  void check_range(const reader::NamedVariable& written) {
    if (!part_->least || !part_->most) return;  // told where the drawing was read
    const auto limits = limits_of(written.variable);
    const std::string type = type_of(written.variable);
    if (!limits)
      return tell("writes numbers, and " + written.name + " is of the type " + type,
                  written.variable.type == ElementaryType::Bool
                      ? "a switch or a button writes a BOOL"
                      : "a set point and a slider write numbers and TIME");
    const std::string range = text_of(*part_->least) + " to " + text_of(*part_->most);
    if (*part_->least < limits->least || *part_->most > limits->most)
      return tell("has the range " + range + ", and " + written.name + " of the type " + type +
                      " does not take all of it",
                  "data-from and data-to within " + text_of(limits->least) + " to " + text_of(limits->most));
    if (bytecode::is_whole_number(written.variable.type) &&
        std::ceil(*part_->least) > std::floor(*part_->most))
      tell("has the range " + range + ", and " + written.name + " takes whole numbers",
           "there is none in it");
  }

  const reader::ProgramInfo& info_;
  const Part* part_ = nullptr;
  result::Diagnostics problems_;
};

}  // namespace

result::Diagnostics check_parts(std::span<const Part> parts, const reader::ProgramInfo& info) {
  PartCheck check(info);
  for (const Part& part : parts)
    if (drawing::writes(part.kind)) check.check(part);
  return check.take();
}

}  // namespace stepwright::screens

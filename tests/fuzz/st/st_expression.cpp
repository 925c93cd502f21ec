#include <bit>
#include <cstdio>

#include "tests/fuzz/st/st_writer.h"

namespace stepwright::st_fuzz {

namespace {

// As strong as in table 71; 0 is the strongest. Operators that are not in the list stand in parentheses.
int strength(Operation operation) {
  switch (operation) {
    case Operation::Multiply:
    case Operation::Divide:
    case Operation::Modulo:
      return 4;
    case Operation::Add:
    case Operation::Subtract:
      return 5;
    case Operation::Less:
    case Operation::Greater:
    case Operation::LessEqual:
    case Operation::GreaterEqual:
      return 6;
    case Operation::Equal:
    case Operation::NotEqual:
      return 7;
    case Operation::And:
      return 8;
    case Operation::Xor:
      return 9;
    case Operation::Or:
      return 10;
    default:
      return 0;
  }
}

const char* symbol(Operation operation) {
  switch (operation) {
    case Operation::Add:
      return "+";
    case Operation::Subtract:
      return "-";
    case Operation::Multiply:
      return "*";
    case Operation::Divide:
      return "/";
    case Operation::Modulo:
      return "MOD";
    case Operation::Power:
      return "**";
    case Operation::Equal:
      return "=";
    case Operation::NotEqual:
      return "<>";
    case Operation::Less:
      return "<";
    case Operation::Greater:
      return ">";
    case Operation::LessEqual:
      return "<=";
    case Operation::GreaterEqual:
      return ">=";
    case Operation::And:
      return "AND";
    case Operation::Or:
      return "OR";
    case Operation::Xor:
      return "XOR";
    case Operation::AndThen:
      return "AND_THEN";
    case Operation::OrElse:
      return "OR_ELSE";
    default:
      return nullptr;
  }
}

const char* function_name(Operation operation) {
  switch (operation) {
    case Operation::Shl:
      return "SHL";
    case Operation::Shr:
      return "SHR";
    case Operation::Rol:
      return "ROL";
    case Operation::Ror:
      return "ROR";
    case Operation::Abs:
      return "ABS";
    case Operation::Sqrt:
      return "SQRT";
    case Operation::Exp:
      return "EXP";
    case Operation::Ln:
      return "LN";
    case Operation::Sin:
      return "SIN";
    case Operation::Atan:
      return "ATAN";
    case Operation::Min:
      return "MIN";
    case Operation::Max:
      return "MAX";
    case Operation::Limit:
      return "LIMIT";
    case Operation::Sel:
      return "SEL";
    case Operation::Mux:
      return "MUX";
    default:
      return nullptr;
  }
}

std::string real_literal(Scalar type, std::uint64_t bits) {
  char text[64];
  if (type == Scalar::Real) {
    std::snprintf(text, sizeof text, "%.9g", std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  } else {
    std::snprintf(text, sizeof text, "%.17g", std::bit_cast<double>(bits));
  }
  std::string out = text;
  const std::size_t exponent = out.find('e');
  if (out.find('.') == std::string::npos)
    out.insert(exponent == std::string::npos ? out.size() : exponent, ".0");
  return std::string(st_name(type)) + "#" + out;
}

bool stands_alone(const Expression& inner) {
  if (inner.operation == Operation::Widen) return stands_alone(*inner.operands[0]);
  return symbol(inner.operation) == nullptr && inner.operation != Operation::Negate &&
         inner.operation != Operation::Not;
}

std::string operand(const Expression& inner, Operation outer, bool left) {
  const Operation operation =
      inner.operation == Operation::Widen ? inner.operands[0]->operation : inner.operation;
  const int binds = strength(operation);
  const bool tight =
      binds > 0 && strength(outer) > 0 && (binds < strength(outer) || (left && binds == strength(outer)));
  return tight || stands_alone(inner) ? st_expression(inner) : "(" + st_expression(inner) + ")";
}

std::string arguments(const Expression& call) {
  std::string out;
  for (const auto& each : call.operands) out += (out.empty() ? "" : ", ") + st_expression(*each);
  return "(" + out + ")";
}

}  // namespace

std::string st_literal(const Type& type, std::uint64_t bits) {
  if (type.kind == TypeKind::Enumeration)
    return type.name + "#" + type.enumerators[bits - static_cast<std::uint64_t>(type.low)];
  if (type.scalar == Scalar::Bool) return bits != 0 ? "TRUE" : "FALSE";
  if (is_real(type.scalar)) return real_literal(type.scalar, bits);
  const auto number = static_cast<std::int64_t>(bits);
  if (type.scalar == Scalar::Time) {
    const std::string digits = std::to_string(number < 0 ? std::uint64_t{0} - bits : bits);
    return std::string(number < 0 ? "T#-" : "T#") + digits + "ns";
  }
  return std::string(st_name(type.scalar)) + "#" +
         (is_signed(type.scalar) ? std::to_string(number) : std::to_string(bits));
}

std::string st_place(const Place& place) {
  std::string out = place.variable->name;
  for (const Step& each : place.steps) {
    if (each.array == nullptr) {
      out += "." + each.field;
      continue;
    }
    std::string indexes;
    for (const auto& index : each.indexes) indexes += (indexes.empty() ? "" : ", ") + st_expression(*index);
    out += "[" + indexes + "]";
  }
  return place.bit < 0 ? out : out + ".%X" + std::to_string(place.bit);
}

std::string st_expression(const Expression& e) {
  const auto first = [&] { return st_expression(*e.operands[0]); };
  const auto guarded = [&] { return stands_alone(*e.operands[0]) ? first() : "(" + first() + ")"; };
  switch (e.operation) {
    case Operation::Literal:
      return st_literal(*e.type, e.bits);
    case Operation::Load:
      return st_place(e.place);
    case Operation::Widen:
      return first();
    case Operation::Convert:
    case Operation::Truncate: {
      const std::string from = st_name(e.operands[0]->type->scalar);
      const std::string to = st_name(e.type->scalar);
      if (e.operation == Operation::Truncate) return from + "_TRUNC_" + to + "(" + first() + ")";
      return (e.anonymous ? "TO_" : from + "_TO_") + to + "(" + first() + ")";
    }
    case Operation::Call:
      return e.callee->name + arguments(e);
    case Operation::Negate:
      return "-" + guarded();
    case Operation::Not:
      return "NOT " + guarded();
    default:
      break;
  }
  if (const char* name = function_name(e.operation)) return name + arguments(e);
  return operand(*e.operands[0], e.operation, true) + " " + symbol(e.operation) + " " +
         operand(*e.operands[1], e.operation, false);
}

}  // namespace stepwright::st_fuzz

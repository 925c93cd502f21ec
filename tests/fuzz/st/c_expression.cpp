#include "tests/fuzz/st/c_expression.h"

#include <bit>
#include <cstdio>

namespace stepwright::st_fuzz {

namespace {

// Of c/meaning.h.
const char* helper(Operation operation) {
  switch (operation) {
    case Operation::Negate:
      return "neg";
    case Operation::Add:
      return "add";
    case Operation::Subtract:
      return "sub";
    case Operation::Multiply:
      return "mul";
    case Operation::Divide:
      return "div";
    case Operation::Modulo:
      return "mod";
    case Operation::Power:
      return "pow";
    case Operation::Shl:
      return "shl";
    case Operation::Shr:
      return "shr";
    case Operation::Rol:
      return "rol";
    case Operation::Ror:
      return "ror";
    case Operation::Abs:
      return "abs";
    case Operation::Sqrt:
      return "sqrt";
    case Operation::Exp:
      return "exp";
    case Operation::Ln:
      return "ln";
    case Operation::Sin:
      return "sin";
    case Operation::Atan:
      return "atan";
    case Operation::Min:
      return "min";
    case Operation::Max:
      return "max";
    default:
      return nullptr;
  }
}

const char* symbol(Operation operation) {
  switch (operation) {
    case Operation::Equal:
      return " == ";
    case Operation::NotEqual:
      return " != ";
    case Operation::Less:
      return " < ";
    case Operation::Greater:
      return " > ";
    case Operation::LessEqual:
      return " <= ";
    case Operation::GreaterEqual:
      return " >= ";
    case Operation::And:
      return " & ";
    case Operation::Or:
      return " | ";
    default:
      return " ^ ";
  }
}

}  // namespace

std::string CExpressions::type_name(const Type& type) const {
  return type.is_scalar() ? c_name(type.scalar) : prefix_ + type.name;
}

std::string CExpressions::keep(const std::string& c_type, const std::string& text) {
  const std::string name = fresh();
  line(c_type + " " + name + " = " + text + ";");
  return name;
}

std::string CExpressions::literal(const Type& type, std::uint64_t bits) {
  char text[64];
  if (type.scalar == Scalar::Real) {
    std::snprintf(text, sizeof text, "%af",
                  static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits))));
  } else if (type.scalar == Scalar::Lreal) {
    std::snprintf(text, sizeof text, "%a", std::bit_cast<double>(bits));
  } else {
    std::snprintf(text, sizeof text, "(%s)0x%llxull", c_name(type.scalar),
                  static_cast<unsigned long long>(bits));
  }
  return text;
}

std::string CExpressions::variable(const Variable& variable) const {
  const bool is_function = pou_->kind == PouKind::Function;
  const bool by_reference =
      variable.section == Section::InOut || (is_function && variable.section == Section::Output);
  std::string name =
      is_function || variable.section == Section::Temp ? variable.name : "self->" + variable.name;
  return by_reference ? "(*" + name + ")" : name;
}

std::string CExpressions::place(const Place& place) {
  std::string out = variable(*place.variable);
  for (const Step& each : place.steps) {
    if (each.array == nullptr) {
      out += "." + each.field;
      continue;
    }
    std::string flat;
    for (std::size_t i = 0; i < each.indexes.size(); ++i) {
      const Bounds& bounds = each.array->bounds[i];
      const std::string index = value(*each.indexes[i]);
      const std::string checked =
          keep("int64_t", "checked_index(" + index + ", " + std::to_string(bounds.low) + ", " +
                              std::to_string(bounds.high) + ")");
      flat = flat.empty() ? checked : "(" + flat + ") * " + std::to_string(bounds.count()) + " + " + checked;
    }
    out += ".at[" + flat + "]";
  }
  return out;
}

std::string CExpressions::load(const Place& place) {
  const std::string text = this->place(place);
  if (place.bit < 0) return keep(type_name(*place.type), text);
  return keep("uint8_t", text + " >> " + std::to_string(place.bit) + " & 1");
}

void CExpressions::store(const Type& type, int bit, const std::string& lvalue, const std::string& value) {
  if (bit >= 0) {
    const std::string mask = "((uint64_t)1 << " + std::to_string(bit) + ")";
    return line("if (" + value + ") " + lvalue + " |= " + mask + "; else " + lvalue + " &= ~" + mask + ";");
  }
  if (type.kind == TypeKind::Subrange)
    line("if (" + value + " < " + std::to_string(type.low) + " || " + value + " > " +
         std::to_string(type.high) + ") trap(SUBRANGE_RANGE);");
  line(lvalue + " = " + value + ";");
}

std::string CExpressions::conversion(const Expression& e, const std::string& operand) {
  const Scalar from = e.operands[0]->type->scalar;
  const Scalar to = e.type->scalar;
  const std::string cast = std::string("(") + c_name(to) + ")";
  const std::string name = st_name(to);
  if (e.operation == Operation::Truncate) return "trunc_" + name + "(" + operand + ")";
  if (to == Scalar::Bool) return operand + " != 0";
  if (from == Scalar::Time && to != Scalar::Time) {
    if (!is_real(to)) return cast + "(" + operand + " / 1000000)";
    const std::string ms = "(double)" + operand + " / 1e6";
    return to == Scalar::Real ? "to_single(" + ms + ")" : ms;
  }
  if (to == Scalar::Time && from != Scalar::Time) {
    if (is_real(from)) return "round_TIME((double)" + operand + " * 1e6)";
    return "(int64_t)((uint64_t)" + operand + " * 1000000u)";
  }
  if (is_real(from) && !is_real(to)) return "round_" + name + "(" + operand + ")";
  if (from == Scalar::Lreal && to == Scalar::Real) return "to_single(" + operand + ")";
  return cast + operand;
}

// The right operand has lines of its own.
std::string CExpressions::short_circuit(const Expression& e) {
  const std::string result = keep("uint8_t", value(*e.operands[0]));
  line(std::string("if (") + (e.operation == Operation::AndThen ? "" : "!") + result + ") {");
  line(result + " = " + value(*e.operands[1]) + ";\n}");
  return result;
}

std::string CExpressions::selection(const Expression& e) {
  const std::string type = c_name(e.type->scalar);
  if (e.operation == Operation::Sel) {
    const std::string in0 = value(*e.operands[1]);
    const std::string in1 = value(*e.operands[2]);
    return keep(type, value(*e.operands[0]) + " ? " + in1 + " : " + in0);
  }
  const std::string number = value(*e.operands[0]);
  const std::size_t count = e.operands.size() - 1;
  line("checked_index(" + number + ", 0, " + std::to_string(count - 1) + ");");
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) text += (i > 1 ? ", " : "") + value(*e.operands[i]);
  return keep(type, "((const " + type + "[]){" + text + "})[" + number + "]");
}

std::string CExpressions::function(const Expression& e) {
  const std::string type = c_name(e.type->scalar);
  const std::string name = st_name(e.type->scalar);
  if (e.operation == Operation::Limit) {
    const std::string in = value(*e.operands[1]);
    const std::string low = value(*e.operands[0]);
    const std::string lifted = keep(type, "max_" + name + "(" + in + ", " + low + ")");
    return keep(type, "min_" + name + "(" + lifted + ", " + value(*e.operands[2]) + ")");
  }
  std::string first = value(*e.operands[0]);
  const std::string call = helper(e.operation) + ("_" + name) + "(";
  if (e.operands.size() == 1) return keep(type, call + first + ")");
  for (std::size_t i = 1; i < e.operands.size(); ++i)
    first = keep(type, call + first + ", " + value(*e.operands[i]) + ")");
  return first;
}

std::string CExpressions::value(const Expression& e) {
  const std::string type = c_name(e.type->scalar);
  switch (e.operation) {
    case Operation::Literal:
      return keep(type, literal(*e.type, e.bits));
    case Operation::Load:
      return load(e.place);
    case Operation::Widen:
    case Operation::Convert:
    case Operation::Truncate:
      return keep(type, conversion(e, value(*e.operands[0])));
    case Operation::Call: {
      std::string arguments;
      std::size_t i = 0;
      for (const Variable& each : e.callee->variables) {
        if (each.section != Section::Input) continue;
        const std::string argument = keep(type_name(*each.type), "0");
        store(*each.type, -1, argument, value(*e.operands[i++]));
        arguments += (arguments.empty() ? "" : ", ") + argument;
      }
      return keep(type, prefix_ + e.callee->name + "(" + arguments + ")");
    }
    case Operation::Not:
      return keep(type, (e.type->scalar == Scalar::Bool ? "!" : "~") + value(*e.operands[0]));
    case Operation::AndThen:
    case Operation::OrElse:
      return short_circuit(e);
    case Operation::Sel:
    case Operation::Mux:
      return selection(e);
    default:
      break;
  }
  if (helper(e.operation) != nullptr || e.operation == Operation::Limit) return function(e);
  const std::string left = value(*e.operands[0]);
  return keep(type, left + symbol(e.operation) + value(*e.operands[1]));
}

}  // namespace stepwright::st_fuzz

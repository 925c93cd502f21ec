#include "ladder/exchange/omron_statements.h"

#include <cctype>

#include "ladder/exchange/st_assignments.h"
#include "ladder/graphic/identifier.h"
#include "ladder/source/codes.h"

namespace stepwright::exchange {
namespace {

using graphic::CoilKind;
using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;

constexpr const char* joins[] = {"LD", "AND", "OR"};

// Symbol and function code of the comparison instructions, unsigned and signed.
std::string comparison_name(CompareOp op, bool is_unsigned) {
  constexpr const char* symbols[] = {"=", "<>", "<", "<=", ">", ">="};
  constexpr int codes[] = {300, 305, 310, 315, 320, 325};
  const auto i = static_cast<std::size_t>(op);
  return std::string(symbols[i]) + (is_unsigned ? "" : "S") + "(" +
         std::to_string(codes[i] + (is_unsigned ? 0 : 2)) + ")";
}

// An integer literal without base: "42", "-7", "1_000", "INT#5".
std::optional<long> integer_literal(std::string text) {
  const std::size_t hash = text.find('#');
  if (hash != std::string::npos) {
    const std::string type = graphic::upper(text.substr(0, hash));
    if (type != "INT" && type != "UINT") return std::nullopt;
    text.erase(0, hash + 1);
  }
  std::string digits;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(text[i])) != 0) digits += text[i];
    const bool sign = i == 0 && (text[i] == '-' || text[i] == '+');
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0 && text[i] != '_' && !sign)
      return std::nullopt;
  }
  if (digits.empty() || digits.size() > 9) return std::nullopt;
  return text[0] == '-' ? -std::stol(digits) : std::stol(digits);
}

}  // namespace

void OmronStatements::fail(const char* code, const std::string& what, const std::string& hint) {
  result::Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.message = place_ + ": " + what;
  diagnostic.hint = hint;
  diagnostics_.push_back(std::move(diagnostic));
}

void OmronStatements::unsupported(const std::string& what, const std::string& hint) {
  fail(source::code::kOmronConstruct, what, hint);
}

void OmronStatements::comment(const std::string& text) {
  std::string flat = text;
  for (char& c : flat) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  line("'" + flat);
}

void OmronStatements::rung(const graphic::Rung& rung, const std::string& place,
                           const std::string& first_scan) {
  place_ = place;
  if (!rung.label.empty() || !rung.jump_to.empty() || rung.is_return) {
    unsupported("jumps, labels and returns are not exported");
    return;
  }
  const std::size_t outputs = rung.blocks.size() + rung.coils.size();
  // The controller clears its first cycle flag by itself.
  const bool clears_first_scan = outputs == 1 && rung.coils.size() == 1 && !first_scan.empty() &&
                                 rung.coils[0].kind == CoilKind::Reset &&
                                 graphic::same_name(rung.coils[0].variable, first_scan);
  if (outputs == 0 || clears_first_scan) return;
  if (!rung.comment.empty()) comment(rung.comment);
  condition(rung.condition, Join::Load);
  for (const graphic::Block& each : rung.blocks) block(each, outputs == 1);
  for (const graphic::Coil& each : rung.coils) coil(each);
}

void OmronStatements::condition(const Condition& node, Join join) {
  switch (node.kind) {
    case ConditionKind::True:
      line(std::string(joins[static_cast<std::size_t>(join)]) + " CF113");  // P_On, the always-on flag
      return;
    case ConditionKind::Contact:
      contact(node, join);
      return;
    case ConditionKind::Comparison:
      comparison(node, join);
      return;
    case ConditionKind::All:
    case ConditionKind::Any:
      group(node, join);
      return;
    case ConditionKind::Expression:
      unsupported("the expression '" + node.name + "' is not exported",
                  "write it with contacts and comparisons");
      return;
  }
}

void OmronStatements::contact(const Condition& node, Join join) {
  const std::string address = bit(node.name, false);
  if (address.empty()) return;
  if (node.negated && node.edge != Edge::None) {
    unsupported("a negated edge of '" + node.name + "' is not exported");
    return;
  }
  const char* edge = node.edge == Edge::Rising ? "@" : node.edge == Edge::Falling ? "%" : "";
  line(edge + std::string(joins[static_cast<std::size_t>(join)]) + (node.negated ? "NOT " : " ") + address);
}

void OmronStatements::comparison(const Condition& node, Join join) {
  const OmronPlace* left_place = word_place(node.name);
  const OmronPlace* right_place = word_place(node.operand);
  const OmronPlace* either = left_place != nullptr ? left_place : right_place;
  const bool is_unsigned = either != nullptr && either->is_unsigned;
  if (left_place != nullptr && right_place != nullptr &&
      left_place->is_unsigned != right_place->is_unsigned) {
    unsupported("the comparison " + graphic::to_st(node) + " mixes a signed with an unsigned word");
    return;
  }
  const std::string left = word(node.name, is_unsigned);
  const std::string right = word(node.operand, is_unsigned);
  if (left.empty() || right.empty()) {
    unsupported("the comparison " + graphic::to_st(node) + " is not exported",
                "operands are words with an address and integers of 16 bits");
    return;
  }
  line(joins[static_cast<std::size_t>(join)] + comparison_name(node.op, is_unsigned) + " " + left + " " +
       right);
}

// A series continues with AND, parallel branches with OR; a group of the other kind becomes a block of its
// own.
void OmronStatements::group(const Condition& node, Join join) {
  const Join own = node.kind == ConditionKind::All ? Join::And : Join::Or;
  const bool block = join != Join::Load && join != own;
  bool first = block || join == Join::Load;
  for (const Condition& child : node.children) {
    condition(child, first ? Join::Load : own);
    first = false;
  }
  if (block) line(join == Join::And ? "ANDLD" : "ORLD");
}

void OmronStatements::coil(const graphic::Coil& coil) {
  constexpr const char* names[] = {"OUT", "OUTNOT", "SET", "RSET", "DIFU(013)", "DIFD(014)"};
  const std::string address = bit(coil.variable, true);
  if (!address.empty()) line(std::string(names[static_cast<std::size_t>(coil.kind)]) + " " + address);
}

void OmronStatements::block(const graphic::Block& block, bool alone) {
  if (block.type.empty()) {
    const auto assignments = assignments_of(block.st_body);
    if (!assignments) {
      unsupported("the statements \"" + block.st_body + "\" are not exported", "assignments of words are");
      return;
    }
    for (const Assignment& each : *assignments) assignment(each.target, each.expression);
  } else if (graphic::same_name(block.type, "TON")) {
    timer(block, alone);
  } else if (graphic::same_name(block.type, "MOVE") && block.power_input.empty() &&
             block.inputs.size() == 1 && block.outputs.size() == 1) {
    assignment(block.outputs[0].second, block.inputs[0].second);
  } else {
    unsupported("the block " + block.type + " is not exported", "TON, MOVE and assignments are");
  }
}

void OmronStatements::timer(const graphic::Block& block, bool alone) {
  const OmronPlace* place = addresses_.find(block.instance + ".Q");
  const bool takes_power = graphic::same_name(block.power_input, "IN");
  const bool preset = block.inputs.size() == 1 && graphic::same_name(block.inputs[0].first, "PT");
  const std::int64_t ns = preset ? time_literal_ns(block.inputs[0].second).value_or(-1) : -1;
  if (place == nullptr || !takes_power || ns < 0) {
    unsupported("the timer '" + block.instance + "' is not exported",
                "its PT has to be a literal such as T#2s");
    return;
  }
  // BCD set values: four digits of 0.1 s, or of 0.01 s with the high-speed timer.
  const std::int64_t tenths = ns / 100'000'000;
  const std::int64_t hundredths = ns / 10'000'000;
  const bool slow = ns % 100'000'000 == 0 && tenths <= 9999;
  const bool fast = ns % 10'000'000 == 0 && hundredths <= 9999;
  if (ns == 0 || (!slow && !fast)) {
    unsupported(
        "the time " + block.inputs[0].second + " of timer '" + block.instance + "' has no exact set value",
        "TIM takes 0.1 s to 999.9 s in steps of 0.1 s, TIMH 0.01 s to 99.99 s in steps of 0.01 s");
    return;
  }
  std::string value = std::to_string(slow ? tenths : hundredths);
  value.insert(0, 4 - value.size(), '0');
  line(std::string(slow ? "TIM " : "TIMH(015) ") + place->code.substr(1) + " #" + value);
  for (const auto& [pin, variable] : block.outputs) {
    if (!graphic::same_name(pin, "Q") || !alone) {
      unsupported("output " + pin + " of timer '" + block.instance + "' is not exported",
                  "test " + block.instance + ".Q");
      continue;
    }
    const std::string address = bit(variable, true);
    line("LD " + place->code);
    line("OUT " + address);
  }
}

// `x := y`, `x := y + z`, `x := y - z` of words.
void OmronStatements::assignment(const std::string& target, const std::string& expression) {
  const OmronPlace* to = word_place(target);
  const std::string whole = to == nullptr || to->is_input ? "" : word(expression, to->is_unsigned);
  if (!whole.empty()) {
    line("MOV(021) " + whole + " " + to->code);
    return;
  }
  const std::size_t op = expression.find_first_of("+-", 1);
  if (to != nullptr && !to->is_input && op != std::string::npos && op > 1 && op + 2 < expression.size()) {
    const std::string left = word(expression.substr(0, op - 1), to->is_unsigned);
    const std::string right = word(expression.substr(op + 2), to->is_unsigned);
    const bool spaced = expression[op - 1] == ' ' && expression[op + 1] == ' ';
    if (spaced && !left.empty() && !right.empty()) {
      line((expression[op] == '+' ? "+(400) " : "-(410) ") + left + " " + right + " " + to->code);
      return;
    }
  }
  unsupported("the assignment '" + target + " := " + expression + "' is not exported",
              "a word takes a word, a constant, or the sum or difference of two");
}

void OmronStatements::initialise(const OmronPlace& place, const std::string& literal) {
  place_ = "initial value of " + place.shown;
  if (place.kind == OmronPlace::Kind::Bit) {
    line("SET " + place.code);
    return;
  }
  const std::string constant = word(literal, place.is_unsigned);
  if (constant.empty()) unsupported("'" + literal + "' is no integer of 16 bits");
  line("MOV(021) " + constant + " " + place.code);
}

std::string OmronStatements::bit(const std::string& variable, bool write) {
  const OmronPlace* place = addresses_.find(variable);
  if (place == nullptr) {
    fail(source::code::kOmronAddress, "'" + variable + "' has no Omron address",
         "give it one, such as I0.00");
    return {};
  }
  const bool writable = place->kind == OmronPlace::Kind::Bit && !place->is_input;
  if (place->kind == OmronPlace::Kind::Word || (write && !writable)) {
    unsupported("'" + variable + "' at " + place->shown +
                (write ? " cannot be driven by a coil" : " is no bit"));
    return {};
  }
  return place->code;
}

const OmronPlace* OmronStatements::word_place(const std::string& text) const {
  const OmronPlace* place = addresses_.find(text);
  return place != nullptr && place->kind == OmronPlace::Kind::Word ? place : nullptr;
}

std::string OmronStatements::word(const std::string& text, bool is_unsigned) {
  if (const OmronPlace* place = word_place(text); place != nullptr) return place->code;
  const std::optional<long> number = integer_literal(text);
  if (!number) return {};
  if (is_unsigned) return *number >= 0 && *number <= 65535 ? "&" + std::to_string(*number) : std::string();
  if (*number < -32768 || *number > 32767) return {};
  return (*number < 0 ? "" : "+") + std::to_string(*number);
}

}  // namespace stepwright::exchange

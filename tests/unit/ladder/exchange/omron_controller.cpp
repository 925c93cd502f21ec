#include "tests/unit/ladder/exchange/omron_controller.h"

#include <sstream>
#include <stdexcept>

namespace stepwright::exchange {

OmronController::OmronController(const std::string& statements) {
  std::istringstream lines(statements);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '\'') continue;
    std::istringstream words(line);
    Instruction instruction;
    words >> instruction.name;
    for (std::string word; words >> word;) instruction.operands.push_back(word);
    program_.push_back(std::move(instruction));
  }
}

void OmronController::cycle(std::int64_t now_ns) {
  now_ns_ = now_ns;
  bits_["CF113"] = true;
  bits_["A200.11"] = first_cycle_;
  for (const Instruction& instruction : program_) execute(instruction);
  first_cycle_ = false;
}

bool OmronController::bit(const std::string& address) const {
  const auto found = bits_.find(address);
  return found != bits_.end() && found->second;
}

int OmronController::word(const std::string& address) const {
  const auto found = words_.find(address);
  return found == words_.end() ? 0 : found->second;
}

int OmronController::operand(const std::string& text) const {
  if (text[0] == '+' || text[0] == '-') return std::stoi(text);
  if (text[0] == '&') return std::stoi(text.substr(1));
  return word(text);
}

// The value that LD, AND and OR bring in: a bit, or a comparison.
bool OmronController::input(const std::string& mnemonic, const Instruction& instruction) const {
  if (mnemonic.empty()) return bit(instruction.operands.at(0));
  if (mnemonic == "NOT") return !bit(instruction.operands.at(0));
  const int a = operand(instruction.operands.at(0));
  const int b = operand(instruction.operands.at(1));
  if (mnemonic == "=S(302)") return a == b;
  if (mnemonic == "<>S(307)") return a != b;
  if (mnemonic == "<S(312)") return a < b;
  if (mnemonic == "<=S(317)") return a <= b;
  if (mnemonic == ">S(322)") return a > b;
  if (mnemonic == ">=S(327)") return a >= b;
  throw std::runtime_error("unknown input: " + instruction.name);
}

bool OmronController::logic(const Instruction& instruction) {
  const std::string& name = instruction.name;
  if (name == "ANDLD" || name == "ORLD") {
    const bool top = stack_.back();
    stack_.pop_back();
    stack_.back() = name == "ANDLD" ? stack_.back() && top : stack_.back() || top;
    return true;
  }
  if (name.rfind("LD", 0) == 0) {
    stack_.push_back(input(name.substr(2), instruction));
  } else if (name.rfind("AND", 0) == 0) {
    stack_.back() = input(name.substr(3), instruction) && stack_.back();
  } else if (name.rfind("OR", 0) == 0) {
    stack_.back() = input(name.substr(2), instruction) || stack_.back();
  } else {
    return false;
  }
  return true;
}

bool OmronController::output(const Instruction& instruction) {
  const std::string& name = instruction.name;
  if (stack_.size() != 1) throw std::runtime_error(name + ": blocks left open");
  const bool power = stack_.back();
  const std::string& first = instruction.operands.at(0);
  if (name == "OUT") {
    bits_[first] = power;
  } else if (name == "OUTNOT") {
    bits_[first] = !power;
  } else if (name == "SET" || name == "RSET") {
    if (power) bits_[first] = name == "SET";
  } else if (name == "MOV(021)") {
    if (power) words_[instruction.operands.at(1)] = operand(first);
  } else if (name == "+(400)" || name == "-(410)") {
    const int right = operand(instruction.operands.at(1));
    if (power) words_[instruction.operands.at(2)] = operand(first) + (name[0] == '+' ? right : -right);
  } else if (name == "TIM") {
    time(instruction, 100'000'000);
  } else if (name == "TIMH(015)") {
    time(instruction, 10'000'000);
  } else {
    return false;
  }
  return true;
}

void OmronController::time(const Instruction& instruction, std::int64_t unit_ns) {
  Timer& timer = timers_[instruction.operands.at(0)];
  const bool power = stack_.back();
  if (power && !timer.running) timer.since_ns = now_ns_;
  timer.running = power;
  const std::int64_t set_value = std::stoll(instruction.operands.at(1).substr(1)) * unit_ns;
  bits_["T" + instruction.operands.at(0)] = power && now_ns_ - timer.since_ns >= set_value;
}

void OmronController::execute(const Instruction& instruction) {
  // Outputs keep the execution condition; the next LD that follows one starts a new block.
  if (instruction.name == "END(001)") return;
  if (after_output_ && instruction.name.rfind("LD", 0) == 0) stack_.clear();
  if (logic(instruction)) {
    after_output_ = false;
    return;
  }
  if (!output(instruction)) throw std::runtime_error("unknown instruction: " + instruction.name);
  after_output_ = true;
}

}  // namespace stepwright::exchange

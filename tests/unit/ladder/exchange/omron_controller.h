#pragma once

// Executes a statement list as an Omron CJ controller would: a test's view of the instructions that the
// writer emits, written from their definition and not from the writer.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace stepwright::exchange {

class OmronController {
 public:
  // Throws std::runtime_error for an instruction that it does not know.
  explicit OmronController(const std::string& statements);

  void cycle(std::int64_t now_ns);

  bool bit(const std::string& address) const;
  int word(const std::string& address) const;
  void set_bit(const std::string& address, bool value) { bits_[address] = value; }
  void set_word(const std::string& address, int value) { words_[address] = value; }

 private:
  struct Instruction {
    std::string name;
    std::vector<std::string> operands;
  };
  struct Timer {
    bool running = false;
    std::int64_t since_ns = 0;
  };

  void execute(const Instruction& instruction);
  bool logic(const Instruction& instruction);
  bool output(const Instruction& instruction);
  bool input(const std::string& mnemonic, const Instruction& instruction) const;
  void time(const Instruction& instruction, std::int64_t unit_ns);
  int operand(const std::string& text) const;

  std::vector<Instruction> program_;
  std::map<std::string, bool> bits_;
  std::map<std::string, int> words_;
  std::map<std::string, Timer> timers_;
  std::vector<bool> stack_;
  std::int64_t now_ns_ = 0;
  bool first_cycle_ = true;
  bool after_output_ = true;
};

}  // namespace stepwright::exchange

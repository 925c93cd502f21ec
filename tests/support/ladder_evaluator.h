#pragma once

// A small evaluator of ladder diagrams for tests: contacts, comparisons, coils, TON and statement lists of
// assignments `a := b;`, `a := b + c;`, `a := b - c;`. It shares nothing with the compiler and the VM.

#include <cstdint>
#include <map>
#include <string>

#include "ladder/graphic/project.h"

namespace stepwright::support {

class LadderEvaluator {
 public:
  // Variables start with their initial value. Anything that it cannot evaluate throws std::runtime_error.
  explicit LadderEvaluator(const graphic::Pou& ladder);

  // One scan at a time from any origin, in ns.
  void scan(std::int64_t now_ns);

  std::int64_t get(const std::string& name) const;
  void set(const std::string& name, std::int64_t value) { values_[name] = value; }

 private:
  bool test(const graphic::Condition& condition) const;
  std::int64_t value(const std::string& operand) const;
  void run(const graphic::Block& block, bool power);
  void run_statements(const std::string& text);
  void drive(const graphic::Coil& coil, bool power);

  struct Timer {
    bool running = false;
    std::int64_t since_ns = 0;
  };

  const graphic::LadderProgram& program_;
  std::map<std::string, std::int64_t> values_;
  std::map<std::string, Timer> timers_;
  std::int64_t now_ns_ = 0;
};

// A literal of TIME (ns), BOOL or an integer; throws std::runtime_error for anything else.
std::int64_t literal(const std::string& text);

}  // namespace stepwright::support

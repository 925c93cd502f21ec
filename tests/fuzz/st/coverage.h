#pragma once

// Coverage of the generated programs: the constructs that they have and how they ended.

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "tests/fuzz/st/generator.h"
#include "tests/fuzz/st/trial.h"

namespace stepwright::st_fuzz {

class Coverage {
 public:
  explicit Coverage(Language language) : whole_(language == Language::Whole) {}

  void add(const Program& program, const Outcome& outcome);

  // Constructs that no program has; empty if there is none.
  std::string missing() const;
  // Percent of the programs that trapped in their first scan.
  unsigned first_scan_traps() const { return programs_ == 0 ? 0 : first_traps_ * 100 / programs_; }
  std::string table() const;

 private:
  void walk(const Pou& pou);
  void walk(const Statements& statements);
  void walk(const Expression& expression);
  void walk(const Place& place);

  std::array<unsigned, kOperations> operations_{};
  std::array<unsigned, kStatementKinds> statements_{};
  std::array<bool, kOperations> has_operation_{};
  std::array<bool, kStatementKinds> has_statement_{};
  std::map<std::string, unsigned> constructs_;  // those that are text, charts, tasks
  std::set<std::string> has_construct_;
  bool whole_ = false;
  std::array<unsigned, 16> traps_{};
  unsigned first_traps_ = 0;
  unsigned programs_ = 0;
};

}  // namespace stepwright::st_fuzz

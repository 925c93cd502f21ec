#pragma once

// Addresses of Omron CJ controllers and which variable lives where. Internal to this folder.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ladder/exchange/omron_writer.h"

namespace stepwright::exchange {

struct OmronPlace {
  enum class Kind : std::uint8_t { Bit, Word, Timer };
  Kind kind = Kind::Bit;
  std::string code;          // in an instruction: "1.00", "W10.00", "D100", "T0000"
  std::string shown;         // in the address table: "Q:1.00"
  bool is_unsigned = false;  // of a Word: compared without sign
  bool is_input = false;     // may not be written
};

// "I0.00", "I:0.00", "Q1.00", "1.00", "W10.15", "H0.00", "A200.11", "D100", "2001"; nullopt for anything else
// or outside the areas of a CJ1M. Bits have two digits.
std::optional<OmronPlace> parse_omron_address(const std::string& text);

// Nanoseconds of a TIME literal ("T#1m2.5s"), or nullopt.
std::optional<std::int64_t> time_literal_ns(const std::string& text);

class OmronAddresses {
 public:
  // Takes the given addresses, then allocates steps, transitions, timers, other bits and words in the order
  // of the POU's variables. What goes wrong is appended to `diagnostics`.
  OmronAddresses(const graphic::Pou& pou, const OmronOptions& options, result::Diagnostics& diagnostics);

  const OmronPlace* find(const std::string& variable) const;
  std::vector<OmronTableRow> table() const;
  // Local variables with the value that they start with, as (place, ST literal; "0" if none is given).
  const std::vector<std::pair<OmronPlace, std::string>>& initial_values() const { return initial_values_; }

 private:
  void take_given(const OmronOptions& options);
  void allocate(const graphic::Pou& pou, const graphic::Variable& variable);
  void assign(const std::string& variable, OmronPlace place, const std::string& comment);
  void next_bit(const graphic::Variable& variable, const char* what, int& next, int first_word, int end_word);
  void next_word(const graphic::Variable& variable, bool is_unsigned);
  void next_timer(const graphic::Variable& variable);
  void miss(const std::string& variable);
  void fail(const char* code, std::string message, std::string hint);

  struct Entry {
    std::string variable;
    OmronPlace place;
    std::string comment;
  };
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t> index_;  // upper case name -> entry
  std::set<std::string> used_;
  std::set<std::string> refused_;  // upper case names whose address was no good: told already
  std::set<std::string> full_;     // areas of which was told that they are full
  std::vector<std::pair<OmronPlace, std::string>> initial_values_;
  result::Diagnostics& diagnostics_;
  int next_step_ = 0;
  int next_transition_ = 0;
  int next_internal_ = 0;
  int next_word_ = 200;
  int next_timer_ = 0;
};

}  // namespace stepwright::exchange

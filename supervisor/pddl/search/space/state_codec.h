#pragma once

// States as they are stored: as few bits as their variables need. A finite-domain variable takes the bits of
// its values; a fluent that is always an integer between known bounds takes the bits of that range; any other
// number is stored once, and the state holds its index. Derived facts are not stored.
//
// Thread rule: one search, one codec (it collects the numbers that it meets).
//
//   StateCodec codec(space.task(), space.domains());
//   codec.pack(state, stored);    codec.unpack(stored, state);

#include <vector>

#include "supervisor/pddl/search/space/finite_domains.h"
#include "supervisor/pddl/search/space/number_table.h"

namespace stepwright::pddl {

class StateCodec {
 public:
  StateCodec(const GroundTask& task, const FiniteDomains& domains);

  // Words of a stored state.
  std::size_t words() const { return words_; }
  void pack(const Word* state, Word* stored);
  void unpack(const Word* stored, Word* state) const;

  // Bytes held.
  std::size_t memory() const { return numbers_.memory(); }

 private:
  // Some bits of a word.
  struct Field {
    std::uint32_t word = 0;
    std::uint32_t shift = 0;
    Word mask = 0;
  };
  struct DomainField {  // facts first .. first + count - 1, of which at most one holds
    Field field;
    int first = 0, count = 0;
  };
  struct RunField {  // neighbouring facts of one word, stored as they are
    Field field;
    std::uint32_t word = 0, shift = 0;
  };
  struct NumberField {
    Field field;
    std::int64_t low = 0;
    bool integer = false;
  };

  void place_facts(const GroundTask& task, const FiniteDomains& domains);
  void place_numbers(const GroundTask& task);
  Field allocate(int bits);
  static Word read(const Word* stored, Field f) { return stored[f.word] >> f.shift & f.mask; }
  static void write(Word* stored, Field f, Word value) { stored[f.word] |= value << f.shift; }

  std::size_t fact_words_, state_words_, words_ = 0;
  std::vector<int> free_bits_;  // of every stored word
  std::vector<DomainField> domains_;
  std::vector<RunField> runs_;
  std::vector<NumberField> fields_;
  NumberTable numbers_;
};

}  // namespace stepwright::pddl

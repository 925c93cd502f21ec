#include "supervisor/pddl/search/space/state_codec.h"

#include <cmath>

#include "supervisor/pddl/search/space/integer_ranges.h"

namespace stepwright::pddl {

StateCodec::StateCodec(const GroundTask& task, const FiniteDomains& domains)
    : fact_words_((task.facts.size() + 63) / 64), state_words_(fact_words_ + task.variables.size()) {
  place_facts(task, domains);
  place_numbers(task);
  words_ = std::max<std::size_t>(1, free_bits_.size());
}

// First fit, wide fields first come first: words are filled well enough.
StateCodec::Field StateCodec::allocate(int bits) {
  std::size_t word = 0;
  while (word < free_bits_.size() && free_bits_[word] < bits) ++word;
  if (word == free_bits_.size()) free_bits_.push_back(64);
  const Field field{static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(64 - free_bits_[word]),
                    bits == 64 ? ~Word{0} : (Word{1} << bits) - 1};
  free_bits_[word] -= bits;
  return field;
}

void StateCodec::place_facts(const GroundTask& task, const FiniteDomains& domains) {
  std::size_t variable = 0;
  for (; variable < domains.size() && domains[variable].count > 1; ++variable) {
    const DomainVariable& v = domains[variable];
    domains_.push_back({allocate(bits_for(static_cast<std::uint64_t>(v.values()))), v.first, v.count});
  }
  // The others are single facts, ascending: each run ends with its word. Derived facts are not stored.
  const int end = task.first_derived;
  for (int first = variable < domains.size() ? domains[variable].first : end; first < end;) {
    const int count = std::min(64 - (first & 63), end - first);
    runs_.push_back(
        {allocate(count), static_cast<std::uint32_t>(first >> 6), static_cast<std::uint32_t>(first & 63)});
    first += count;
  }
}

void StateCodec::place_numbers(const GroundTask& task) {
  const std::vector<bool> integer = integer_variables(task);
  for (std::size_t v = 0; v < task.variables.size(); ++v) {
    const Interval range = task.bounds[v];
    const bool narrow = integer[v] && std::isfinite(range.low) && std::isfinite(range.high) &&
                        std::abs(range.low) < 1e9 && range.high - range.low < 65536.0;
    NumberField field;
    field.integer = narrow;
    field.low = narrow ? static_cast<std::int64_t>(std::floor(range.low)) : 0;
    const double values = narrow ? std::ceil(range.high) - static_cast<double>(field.low) + 1.0 : 0.0;
    field.field = allocate(narrow ? bits_for(static_cast<std::uint64_t>(values)) : 32);
    fields_.push_back(field);
  }
}

void StateCodec::pack(const Word* state, Word* stored) {
  std::fill(stored, stored + words_, 0);
  for (const DomainField& d : domains_) {
    write(stored, d.field, static_cast<Word>(first_bit(state, d.first, d.count)));
  }
  for (const RunField& run : runs_) write(stored, run.field, state[run.word] >> run.shift & run.field.mask);
  for (std::size_t v = 0; v < fields_.size(); ++v) {
    const NumberField& number = fields_[v];
    const Word bits = state[fact_words_ + v];
    if (number.integer) {
      const auto value = static_cast<std::int64_t>(std::bit_cast<double>(bits));
      write(stored, number.field, static_cast<Word>(value - number.low));
    } else {
      write(stored, number.field, numbers_.index_of(bits));
    }
  }
}

void StateCodec::unpack(const Word* stored, Word* state) const {
  std::fill(state, state + fact_words_, 0);
  for (const DomainField& d : domains_) {
    const int value = static_cast<int>(read(stored, d.field));
    const int fact = d.first + value;
    if (value < d.count) state[fact >> 6] |= Word{1} << (fact & 63);
  }
  for (const RunField& run : runs_) state[run.word] |= read(stored, run.field) << run.shift;
  for (std::size_t v = 0; v < fields_.size(); ++v) {
    const NumberField& number = fields_[v];
    const Word value = read(stored, number.field);
    state[fact_words_ + v] =
        number.integer
            ? std::bit_cast<Word>(static_cast<double>(static_cast<std::int64_t>(value) + number.low))
            : numbers_[value];
  }
}

}  // namespace stepwright::pddl

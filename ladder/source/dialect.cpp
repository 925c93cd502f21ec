#include "ladder/source/dialect.h"

#include <algorithm>

namespace stepwright::source {

std::span<const Dialect> dialects() {
  static constexpr Dialect kDialects[] = {
      {},
      {.name = "matiec",
       .written_inputs = true,
       .real_to_bits = true,
       .double_quotes = true,
       .open_blocks = true,
       .loose_addresses = true,
       .old_exchange = true,
       .extension_types = true},
      {.name = "codesys",
       .written_inputs = true,
       .dotted_enumerators = true,
       .qualified_globals = true,
       .bits_calculate = true,
       .integer_parts = true,
       .pointers = true,
       .loose_ends = true,
       .real_to_bits = true,
       .exported_tasks = true},
  };
  return kDialects;
}

const Dialect* find_dialect(std::string_view name) {
  const auto all = dialects();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Dialect& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string with_dialects(std::string hint, Permission permission) {
  std::string names;
  std::size_t count = 0;
  for (const Dialect& each : dialects()) {
    if (!(each.*permission)) continue;
    names += (names.empty() ? "--dialect " : " and ") + std::string(each.name);
    ++count;
  }
  return (hint.empty() ? "" : hint + "; ") + names + (count > 1 ? " take it" : " takes it");
}

}  // namespace stepwright::source

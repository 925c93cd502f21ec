#include "supervisor/ltl/trace/binding.h"

#include <array>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr std::array<std::pair<std::string_view, Relation>, 6> kRelations = {{{"<=", Relation::LessEqual},
                                                                              {">=", Relation::GreaterEqual},
                                                                              {"<>", Relation::Unequal},
                                                                              {"<", Relation::Less},
                                                                              {">", Relation::Greater},
                                                                              {"=", Relation::Equal}}};

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

}  // namespace

result::Result<Binding> read_binding(std::string_view text) {
  Binding binding;
  const std::size_t sign = text.find('=');
  binding.proposition = trimmed(text.substr(0, sign));
  std::string_view rest = sign == std::string_view::npos ? std::string_view() : text.substr(sign + 1);
  const std::size_t at = rest.find_first_of("<>=");
  if (at != std::string_view::npos) {
    for (const auto& [word, relation] : kRelations) {
      if (rest.substr(at, word.size()) != word) continue;
      binding.relation = relation;
      binding.value = trimmed(rest.substr(at + word.size()));
      break;
    }
    rest = rest.substr(0, at);
  }
  binding.column = trimmed(rest);
  if (binding.relation == Relation::Holds && binding.column.starts_with('!')) {
    binding.relation = Relation::HoldsNot;
    binding.column = trimmed(std::string_view(binding.column).substr(1));
  }
  const bool compares = binding.relation != Relation::Holds && binding.relation != Relation::HoldsNot;
  if (binding.proposition.empty() || binding.column.empty() || (compares && binding.value.empty())) {
    return result::fail("L0043", {}, "'" + std::string(text) + "' does not say what a proposition means",
                        "NAME=COLUMN, NAME=!COLUMN, or NAME=COLUMN OP VALUE with < <= = <> >= >");
  }
  return binding;
}

}  // namespace stepwright::ltl

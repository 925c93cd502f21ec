#include "ladder/exchange/st_assignments.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "ladder/graphic/identifier.h"

namespace stepwright::exchange {
namespace {

std::string trimmed(const std::string& text) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto begin = std::find_if_not(text.begin(), text.end(), space);
  const auto end = std::find_if_not(text.rbegin(), std::make_reverse_iterator(begin), space).base();
  return {begin, end};
}

bool is_place(const std::string& text) {
  return !text.empty() &&
         (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_' || text[0] == '%') &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '[' ||
                  c == ']' || c == '%';
         });
}

// Words that make a statement more than an expression.
bool has_statement_word(const std::string& text) {
  constexpr std::array<const char*, 16> words{"IF",       "THEN",  "ELSE",   "ELSIF",   "END_IF", "FOR",
                                              "DO",       "WHILE", "CASE",   "REPEAT",  "UNTIL",  "EXIT",
                                              "CONTINUE", "OF",    "RETURN", "END_CASE"};
  std::string word;
  for (const char c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      word += c;
      continue;
    }
    if (std::any_of(words.begin(), words.end(), [&](const char* w) { return graphic::same_name(w, word); }))
      return true;
    word.clear();
  }
  return false;
}

}  // namespace

std::optional<std::vector<Assignment>> assignments_of(const std::string& st) {
  // Strings and comments may hold anything; such a text is not taken apart.
  if (st.find_first_of("'\"") != std::string::npos || st.find("(*") != std::string::npos ||
      st.find("//") != std::string::npos || has_statement_word(st)) {
    return std::nullopt;
  }
  std::vector<Assignment> list;
  for (std::size_t begin = 0; begin < st.size();) {
    const std::size_t end = std::min(st.find(';', begin), st.size());
    const std::string statement = trimmed(st.substr(begin, end - begin));
    begin = end + 1;
    if (statement.empty()) continue;
    const std::size_t assign = statement.find(":=");
    if (assign == std::string::npos) return std::nullopt;
    Assignment assignment{trimmed(statement.substr(0, assign)), trimmed(statement.substr(assign + 2))};
    const bool plain =
        assignment.expression.find(":=") == std::string::npos && !assignment.expression.empty();
    if (!is_place(assignment.target) || !plain) return std::nullopt;
    list.push_back(std::move(assignment));
  }
  return list;
}

}  // namespace stepwright::exchange

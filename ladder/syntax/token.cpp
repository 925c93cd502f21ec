#include "ladder/syntax/token.h"

#include <array>
#include <cassert>

namespace stepwright::syntax {

namespace {

constexpr std::array kKeywords = {
    "",
    "PROGRAM",
    "END_PROGRAM",
    "FUNCTION_BLOCK",
    "END_FUNCTION_BLOCK",
    "FUNCTION",
    "END_FUNCTION",
    "VAR",
    "VAR_INPUT",
    "VAR_OUTPUT",
    "VAR_IN_OUT",
    "VAR_TEMP",
    "VAR_EXTERNAL",
    "VAR_GLOBAL",
    "VAR_CONFIG",
    "VAR_ACCESS",
    "END_VAR",
    "CONSTANT",
    "RETAIN",
    "NON_RETAIN",
    "R_EDGE",
    "F_EDGE",
    "AT",
    "TYPE",
    "END_TYPE",
    "STRUCT",
    "END_STRUCT",
    "ARRAY",
    "OF",
    "REF_TO",
    "CONFIGURATION",
    "END_CONFIGURATION",
    "RESOURCE",
    "END_RESOURCE",
    "ON",
    "TASK",
    "WITH",
    "IF",
    "THEN",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "END_CASE",
    "FOR",
    "TO",
    "BY",
    "DO",
    "END_FOR",
    "WHILE",
    "END_WHILE",
    "REPEAT",
    "UNTIL",
    "END_REPEAT",
    "EXIT",
    "CONTINUE",
    "RETURN",
    "JMP",
    "TRUE",
    "FALSE",
    "NULL",
    "AND",
    "AND_THEN",
    "OR",
    "OR_ELSE",
    "XOR",
    "NOT",
    "MOD",
    "{SFC_FINAL_SCAN}",
    "INITIAL_STEP",
    "STEP",
    "END_STEP",
    "TRANSITION",
    "END_TRANSITION",
    "FROM",
    "ACTION",
    "END_ACTION",
};
static_assert(kKeywords.size() == static_cast<std::size_t>(Keyword::EndAction) + 1);

}  // namespace

void intern_keywords(source::NameTable& names) {
  for (std::size_t i = 0; i < kKeywords.size(); ++i) {
    const source::NameId id = names.intern(kKeywords[i]);
    assert(id.value == i);
    static_cast<void>(id);
  }
}

Keyword keyword_of(source::NameId name) {
  return name.value < kKeywords.size() ? static_cast<Keyword>(name.value) : Keyword::None;
}

const char* to_string(Keyword keyword) {
  return kKeywords[static_cast<std::size_t>(keyword)];
}

const char* describe(TokenKind kind) {
  static constexpr std::array kWords = {"the end of the text",
                                        "an identifier",
                                        "a type prefix",
                                        "an integer",
                                        "a real number",
                                        "a duration",
                                        "a date",
                                        "a time of day",
                                        "a date and time",
                                        "a string",
                                        "a wide string",
                                        "an address",
                                        "':='",
                                        "'?='",
                                        "'=>'",
                                        "':'",
                                        "';'",
                                        "','",
                                        "'.'",
                                        "'..'",
                                        "'('",
                                        "')'",
                                        "'['",
                                        "']'",
                                        "'+'",
                                        "'-'",
                                        "'*'",
                                        "'**'",
                                        "'/'",
                                        "'&'",
                                        "'^'",
                                        "'='",
                                        "'<>'",
                                        "'<'",
                                        "'<='",
                                        "'>'",
                                        "'>='",
                                        "a character that ST does not know",
                                        "a reserved word"};
  static_assert(kWords.size() == static_cast<std::size_t>(TokenKind::Keyword) + 1);
  return kWords[static_cast<std::size_t>(kind)];
}

}  // namespace stepwright::syntax

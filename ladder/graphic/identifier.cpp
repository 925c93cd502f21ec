#include "ladder/graphic/identifier.h"

#include <cctype>

namespace stepwright::graphic {
namespace {

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// IEC 61131-3, table C.2 (delimiters and keywords), without the names of standard functions and blocks, which
// a program may redefine. Every word stands between two spaces.
constexpr std::string_view keywords =
    " ABSTRACT ACTION AND ARRAY AT BOOL BY BYTE CASE CHAR CLASS CONFIGURATION CONSTANT CONTINUE DATE "
    "DATE_AND_TIME DINT DO DT DWORD ELSE ELSIF END_ACTION END_CASE END_CLASS END_CONFIGURATION "
    "END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF END_INTERFACE END_METHOD END_NAMESPACE "
    "END_PROGRAM END_REPEAT END_RESOURCE END_STEP END_STRUCT END_TRANSITION END_TYPE END_VAR "
    "END_WHILE EXIT EXTENDS FALSE FINAL FOR FROM FUNCTION FUNCTION_BLOCK F_EDGE IF IMPLEMENTS "
    "INITIAL_STEP INT INTERFACE INTERNAL INTERVAL LDATE LDT LINT LREAL LTIME LTOD LWORD METHOD MOD "
    "NAMESPACE NON_RETAIN NOT NULL OF ON OR OVERLAP OVERRIDE PRIORITY PRIVATE PROGRAM PROTECTED "
    "PUBLIC READ_ONLY READ_WRITE REAL REF REF_TO REPEAT RESOURCE RETAIN RETURN R_EDGE SINGLE SINT "
    "STEP STRING STRUCT SUPER TASK THEN THIS TIME TIME_OF_DAY TO TOD TRANSITION TRUE TYPE UDINT "
    "UINT ULINT UNTIL USING USINT VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_INPUT "
    "VAR_IN_OUT VAR_OUTPUT VAR_TEMP WCHAR WHILE WITH WORD WSTRING XOR ";

}  // namespace

bool is_identifier(std::string_view text) {
  if (text.empty() || is_digit(text.front()) || text.back() == '_') return false;
  char previous = ' ';
  for (const char c : text) {
    if (!is_letter(c) && !is_digit(c) && c != '_') return false;
    if (c == '_' && previous == '_') return false;
    previous = c;
  }
  return true;
}

bool is_keyword(std::string_view text) {
  return keywords.find(" " + upper(text) + " ") != std::string_view::npos;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = naming::to_upper(c);
  return result;
}

std::string make_identifier(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool legal = is_letter(c) || is_digit(c);
    if (legal) {
      if (result.empty() && is_digit(c)) result += "N";
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  if (result.empty() || is_keyword(result)) result += result.empty() ? "N" : "_1";
  return result;
}

bool NameSet::insert(std::string_view name) {
  return used_.insert(upper(name)).second;
}

bool NameSet::contains(std::string_view name) const {
  return used_.count(upper(name)) != 0;
}

std::string NameSet::unique(std::string_view wanted) {
  const std::string base = make_identifier(wanted);
  if (insert(base)) return base;
  // Numbers that were taken stay taken.
  int& number = numbers_.try_emplace(upper(base), 2).first->second;
  std::string name;
  do {
    name = base + "_" + std::to_string(number++);
  } while (!insert(name));
  return name;
}

}  // namespace stepwright::graphic

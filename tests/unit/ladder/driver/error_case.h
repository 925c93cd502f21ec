#pragma once

// A wrong source, what the compiler says about it, and where.

#include <cstdint>
#include <ostream>
#include <span>

namespace stepwright::driver_test {

struct ErrorCase {
  const char* name;
  const char* code;
  std::uint32_t line;
  std::uint32_t column;
  const char* text;
  const char* hint = nullptr;  // a part of it
};

inline void PrintTo(const ErrorCase& error_case, std::ostream* out) {
  *out << error_case.name;
}

// Mistakes that need the types of edition 3.
std::span<const ErrorCase> type_error_cases();
// Mistakes with strings and characters.
std::span<const ErrorCase> text_error_cases();

// Mistakes in tests and mocks.
std::span<const ErrorCase> test_error_cases();

// Mistakes in configurations.
std::span<const ErrorCase> configuration_error_cases();

// Mistakes by habits from other languages.
std::span<const ErrorCase> habit_error_cases();

}  // namespace stepwright::driver_test

// The body of a program with some variables.
#define BODY(statements) \
  "PROGRAM main\nVAR i, j : INT; b : BOOL; r : REAL; t : TON; a : ARRAY[1..3] OF INT; w : WORD; d : DINT; \
tm : TIME; lamp : BOOL; END_VAR\n" statements "\nEND_PROGRAM\n"

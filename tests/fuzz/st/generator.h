#pragma once

// A random well-typed program: types, functions, function blocks and a PROGRAM main. The same seed gives the
// same program on every machine.
//
//   const auto program = generate(42, Language::Common);
//   write_st(*program, {});  write_c(..., {});

#include "tests/fuzz/st/tree.h"

namespace stepwright::st_fuzz {

enum class Language : std::uint8_t {
  Common,  // what C has a translation for
  Whole,   // with constructs that are text only, charts, ladder diagrams, several tasks
};

// By unique_ptr, as the tree points into itself.
std::unique_ptr<Program> generate(std::uint64_t seed, Language language);

// A value for an input of main: small numbers, the ends of the type, NaN now and then.
std::uint64_t input_value(std::uint64_t seed, std::uint64_t scan, std::size_t input, Scalar type);

}  // namespace stepwright::st_fuzz

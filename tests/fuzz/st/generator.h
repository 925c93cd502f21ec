#pragma once

// A random well-typed program: types, functions, function blocks and a PROGRAM main. The same seed gives the
// same program on every machine.
//
//   const Program program = generate(42);
//   write_st(program, {});  write_c(program, {});

#include "tests/fuzz/st/tree.h"

namespace stepwright::st_fuzz {

// By unique_ptr, as the tree points into itself.
std::unique_ptr<Program> generate(std::uint64_t seed);

// A value for an input of main: small numbers, the ends of the type, NaN now and then.
std::uint64_t input_value(std::uint64_t seed, std::uint64_t scan, std::size_t input, Scalar type);

}  // namespace stepwright::st_fuzz

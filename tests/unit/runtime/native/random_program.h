#pragma once

// Random programs that the verifier accepts: typed expressions and statements, loops, jumps with operands on
// the stack, calls of functions and instances, addresses of every kind, and now and then a trap.

#include <cstdint>
#include <random>
#include <vector>

#include "runtime/bytecode/writer/container_model.h"

namespace stepwright::native {

// Equal seeds give equal programs.
writer::ContainerModel random_program(std::uint32_t seed);

}  // namespace stepwright::native

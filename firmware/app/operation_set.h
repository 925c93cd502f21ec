#pragma once

// Set of operations of programs that this firmware has. The basic one, for controllers with 64 KB of flash,
// is built with STEPWRIGHT_FIRMWARE_BASIC: it lacks the operations of strings and the elementary functions
// (SIN, LN, EXPT and their kind; SQRT is there), and refuses programs that use them.
//
// Pure; any thread.

#include "runtime/bytecode/program.h"

namespace stepwright::app {

#ifdef STEPWRIGHT_FIRMWARE_BASIC
inline constexpr bool kBasic = true;
#else
inline constexpr bool kBasic = false;
#endif

// False if any function of the program uses a string or an elementary function.
bool is_basic(const bytecode::Program& program);

}  // namespace stepwright::app

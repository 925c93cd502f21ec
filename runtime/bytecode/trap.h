#pragma once

// A trap: the located fault (function, pc) that ends a PLC program at run time. It leaves the image as it was
// at the faulting instruction; the scan then puts the outputs into their safe state. Plain data; any thread.
//
// In a function of the library the place of the fault says little to who wrote the program: the trap also
// knows the call that led into the library, the innermost one in a function that is not marked as library.

#include <cstdint>

namespace stepwright::bytecode {

// The numeric values are stable: the Trap instruction carries them and reports show them.
enum class TrapCode : std::uint8_t {
  None = 0,
  DivisionByZero = 1,
  ConversionRange = 2,  // NaN, or a number outside the target's range
  IndexRange = 3,       // array index outside its bounds
  BadReference = 4,     // a Ref outside the memory of the program
  Watchdog = 5,         // the budget of the scan is used up
  BadArgument = 6,      // outside a function's domain (SQRT of a negative number, a text that is no number)
  UserTrap = 7,         // raised by the program itself
  SubrangeRange = 8,    // a value outside the subrange type that it is assigned to
  NullReference = 9,    // a reference that is NULL is followed (or a VAR_IN_OUT that was never bound)
};
inline constexpr std::uint8_t kTrapCodeCount = 10;

struct Trap {
  TrapCode code = TrapCode::None;
  std::uint32_t function = 0;  // index into the function table
  std::uint32_t pc = 0;        // byte offset of the faulting instruction in its function
  // The call into the library: the calling function, and the byte offset behind its call instruction. Both 0
  // if the fault lies in no function of the library: no call ends at 0.
  std::uint32_t caller = 0;
  std::uint32_t return_pc = 0;

  bool in_library() const { return return_pc != 0; }
  explicit operator bool() const { return code != TrapCode::None; }
  friend bool operator==(const Trap&, const Trap&) = default;
};

// "division by zero", ...
const char* name_of(TrapCode code);
// "R0401", ...: names the page that explains the trap (`stepwright explain R0401`).
const char* diagnostic_code_of(TrapCode code);

}  // namespace stepwright::bytecode

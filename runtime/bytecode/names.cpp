#include "runtime/bytecode/trap.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::bytecode {

const char* name_of(ElementaryType type) {
  constexpr const char* kNames[kElementaryTypeCount] = {
      "BOOL",  "SINT", "INT",  "DINT",  "LINT",  "USINT",  "UINT",   "UDINT",
      "ULINT", "BYTE", "WORD", "DWORD", "LWORD", "REAL",   "LREAL",  "TIME",
      "DATE",  "TOD",  "DT",   "CHAR",  "WCHAR", "STRING", "WSTRING"};
  return kNames[static_cast<std::uint8_t>(type)];
}

const char* name_of(TrapCode code) {
  constexpr const char* kNames[kTrapCodeCount] = {"no trap",
                                                  "division by zero",
                                                  "conversion out of range",
                                                  "array index out of bounds",
                                                  "reference outside the image",
                                                  "watchdog: the scan's budget is used up",
                                                  "argument outside the function's domain",
                                                  "trap raised by the program",
                                                  "value outside its subrange",
                                                  "a NULL reference is followed"};
  return kNames[static_cast<std::uint8_t>(code)];
}

const char* diagnostic_code_of(TrapCode code) {
  constexpr const char* kCodes[kTrapCodeCount] = {"R0400", "R0401", "R0402", "R0403", "R0404",
                                                  "R0405", "R0406", "R0407", "R0408", "R0409"};
  return kCodes[static_cast<std::uint8_t>(code)];
}

}  // namespace stepwright::bytecode

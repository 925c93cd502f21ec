#pragma once

// A single value of a program by what a person calls it: the path of a variable, an element or a member
// (`MAIN.levels[3]`, `MAIN.grid[1, 2]`, `P.timer.PT`), or a direct address (`%QX0.2`, `%IW1`).
//
//   auto place = resolve_name(info, "MAIN.levles[3]");
//   place.error();     // R0057: there is no variable `MAIN.levles[3]`; hint: did you mean `MAIN.levels[3]`?
//
// Pure functions; any thread.

#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

struct NamedVariable {
  std::string name;  // as the program spells it; a direct address as it was given
  Variable variable;
};

// A direct address has the type of the variable that is declared there with the same size, else BOOL, BYTE,
// WORD, DWORD or LWORD. Fails with `code` at `where`, with the name that was probably meant.
[[nodiscard]] result::Result<NamedVariable> resolve_name(const ProgramInfo& info, std::string_view name,
                                                         const char* code = "R0057",
                                                         const result::Location& where = {});

// The same, and of an array, a structure or an instance all values inside of it, in the order of the program.
[[nodiscard]] result::Result<std::vector<NamedVariable>> resolve_values(const ProgramInfo& info,
                                                                        std::string_view name,
                                                                        const char* code = "R0057",
                                                                        const result::Location& where = {});

// Name of a place of the image: the variable there, else its direct address, else its bytes. `bit` is 0xFF
// for whole bytes.
std::string name_of_place(const ProgramInfo& info, std::uint32_t address, std::uint8_t bit,
                          std::uint8_t size);

// The variable at such a place, to read and write its value: the declared one or a plain one of the size.
Variable variable_of_place(const ProgramInfo& info, std::uint32_t address, std::uint8_t bit,
                           std::uint8_t size);

}  // namespace stepwright::reader

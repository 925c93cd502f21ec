#pragma once

// Dialect of sources: what they may write beside the standard because the system that they come from takes
// it. It is one object of named permissions, which parser, semantic analysis and the reader of exchange files
// ask. The standard permits nothing. An error that a dialect would permit names the dialect in its hint.
//
// Plain values; pure.
//
//   if (!dialect.integer_parts) error(..., with_dialects("convert it first", &Dialect::integer_parts));

#include <span>
#include <string>
#include <string_view>

namespace stepwright::source {

struct Dialect {
  std::string_view name = "standard";
  bool written_inputs = false;      // a body writes its VAR_INPUT; a warning says so
  bool dotted_enumerators = false;  // Color.Red is Color#Red
  bool qualified_globals = false;   // List.x is the global x of configuration, resource or file List
  bool bits_calculate = false;      // bit strings are unsigned integers where they calculate or are compared
  bool integer_parts = false;       // number.3 is a bit of an integer
  bool pointers = false;            // POINTER TO is REF_TO, ADR is REF, 0 is NULL beside them
  bool loose_ends = false;          // no ';' behind END_IF, END_CASE and the ends of loops
  bool real_to_bits = false;        // REAL_TO_WORD and its like, by way of an unsigned integer
  bool double_quotes = false;       // "text" is a STRING, too
  bool exported_tasks = false;      // PT0.05S, no typeName, configurations without programs
  bool open_blocks = false;         // the VAR of a block is read and written by who holds it: block.x
  bool loose_addresses = false;     // x AT %ML5 : DWORD is in the first bytes of that address
  bool old_exchange = false;     // PLCopen files before version 2: pouInstance type, actions without places
  bool extension_types = false;  // HMI_INT, python_eval and the like are known; the blocks do nothing
};

using Permission = bool Dialect::*;

// The standard first.
std::span<const Dialect> dialects();
inline const Dialect& standard_dialect() {
  return dialects().front();
}
// Null if there is none of that name.
const Dialect* find_dialect(std::string_view name);
// A hint, and which dialects permit it: "convert it first; --dialect codesys takes it".
std::string with_dialects(std::string hint, Permission permission);

}  // namespace stepwright::source

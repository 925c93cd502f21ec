#pragma once

// The names in a piece of ST text, by the language's lexer: what stands in strings, comments, pragmas,
// literals and direct addresses is none. Pure functions; a reader belongs to one thread.

#include <functional>
#include <string>
#include <string_view>

#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

// Calls `visit` with every identifier of `text`, in order, also with those after a dot.
void for_each_identifier(syntax::PieceReader& reader, std::string_view text,
                         const std::function<void(std::string_view)>& visit);

// The same with the first name of each variable of a list: "motor" of "lamp, motor.fault[i]".
void for_each_first_name(syntax::PieceReader& reader, std::string_view list,
                         const std::function<void(std::string_view)>& visit);

// Replaces every `<name>.X`, `.T`, `.Q` and `.A` (not itself after a dot) by what `flag` returns for (name,
// 'X', 'T', 'Q' or 'A'); where it returns an empty string the text stays as it is.
std::string replace_flags(syntax::PieceReader& reader, std::string_view text,
                          const std::function<std::string(std::string_view, char)>& flag);

// Calls `visit` with the name and flag of every `<name>.X` (T, Q, A) that the text assigns to: `S1.X := ...`,
// `f(OUT => S1.X)`.
void for_each_written_flag(syntax::PieceReader& reader, std::string_view text,
                           const std::function<void(std::string_view, char)>& visit);

// True if the text leaves its POU.
bool holds_return(syntax::PieceReader& reader, std::string_view text);

}  // namespace stepwright::lowering

#pragma once

// The names in a piece of ST text, found without parsing it: strings, comments, literals and direct addresses
// are skipped. Pure functions.

#include <functional>
#include <string>
#include <string_view>

namespace stepwright::lowering {

// Calls `visit` with every identifier of `text`, in order, also with those after a dot.
void for_each_identifier(std::string_view text, const std::function<void(std::string_view)>& visit);

// Replaces every `<name>.X`, `.T`, `.Q` and `.A` (not itself after a dot) by what `flag` returns for (name,
// 'X', 'T', 'Q' or 'A'); where it returns an empty string the text stays as it is.
std::string replace_flags(std::string_view text,
                          const std::function<std::string(std::string_view, char)>& flag);

// Calls `visit` with the name and flag of every `<name>.X` (T, Q, A) that the text assigns to: `S1.X := ...`,
// `f(OUT => S1.X)`.
void for_each_written_flag(std::string_view text, const std::function<void(std::string_view, char)>& visit);

}  // namespace stepwright::lowering

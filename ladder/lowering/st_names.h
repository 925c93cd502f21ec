#pragma once

// The names in a piece of ST text, found without parsing it: strings, comments, literals and direct addresses
// are skipped. Pure functions.

#include <functional>
#include <string>
#include <string_view>

namespace stepwright::lowering {

// Calls `visit` with every identifier of `text`, in order, also with those after a dot.
void for_each_identifier(std::string_view text, const std::function<void(std::string_view)>& visit);

// Replaces every `<name>.X` and `<name>.T` (not itself after a dot) by what `flag` returns for (name, 'X' or
// 'T'); where it returns an empty string the text stays as it is.
std::string replace_step_flags(std::string_view text,
                               const std::function<std::string(std::string_view, char)>& flag);

}  // namespace stepwright::lowering

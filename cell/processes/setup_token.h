#pragma once

// The set-up token that the page's server says on standard error, for who has started it and shows it to
// people. Pure; any thread.

#include <optional>
#include <string>
#include <string_view>

namespace stepwright::processes {

// The token in a line of `stepwright hmi`; nothing if the line is about something else.
std::optional<std::string> setup_token_of(std::string_view line);

}  // namespace stepwright::processes

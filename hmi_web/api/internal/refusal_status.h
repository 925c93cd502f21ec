#pragma once

// The status of HTTP with which a refusal is answered, by the code of whoever refuses. Private to
// hmi_web/api. Pure; any thread.

#include <string_view>

namespace stepwright::api {

// 400 for a code without a status of its own: who asked has to ask for something else.
unsigned refusal_status(std::string_view code);

}  // namespace stepwright::api

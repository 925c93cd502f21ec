#pragma once

// Requests of people to a mission of a test.

#include <string>

#include "supervisor/run/mission.h"

namespace stepwright::run {

inline result::Result<void> ask(Mission& mission, const std::string& text) {
  const auto request = Request::parse(text);
  return request ? mission.obey(*request) : tl::unexpected(request.error());
}

// The code with which it is refused; empty: it is not.
inline std::string refusal(Mission& mission, const std::string& text) {
  const auto verdict = ask(mission, text);
  return verdict ? std::string() : verdict.error().front().code;
}

}  // namespace stepwright::run

#pragma once

// Form of a message as a line of the log. Pure functions; any thread.

#include <chrono>
#include <string>
#include <string_view>

#include "runtime/ground/log/logger.h"

namespace stepwright::log {

struct Message {
  std::chrono::system_clock::time_point time;
  LogLevel level = LogLevel::Info;
  std::string_view process;
  std::string_view kind;
  std::string_view text;
};

// "2026-11-22T05:13:47.123Z info    runtime: ...": one line, whatever the text holds. A line break in it
// becomes
// "; ", other control characters "?".
std::string text_line(const Message& message);

// {"time": ..., "level": ..., "process": ..., "kind": ..., "message": ..., fields}. Bytes that are no UTF-8
// are replaced.
std::string json_line(const Message& message, Fields fields);

}  // namespace stepwright::log

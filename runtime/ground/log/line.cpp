#include "runtime/ground/log/line.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

namespace stepwright::log {
namespace {

const char* word(LogLevel level) {
  switch (level) {
    case LogLevel::Debug:
      return "debug";
    case LogLevel::Info:
      return "info";
    case LogLevel::Warning:
      return "warning";
    case LogLevel::Error:
      return "error";
  }
  return "";
}

// UTC to the millisecond (ISO 8601).
std::string stamp(std::chrono::system_clock::time_point time) {
  const auto since = std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  const auto whole = static_cast<std::time_t>(seconds.count());
  std::tm parts{};
  gmtime_r(&whole, &parts);
  std::array<char, 24> text{};
  const std::size_t used = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 8> fraction{};
  std::snprintf(fraction.data(), fraction.size(), ".%03dZ", static_cast<int>((since - seconds).count()));
  return std::string(text.data(), used) + fraction.data();
}

}  // namespace

std::string text_line(const Message& message) {
  std::string line = stamp(message.time) + " " + word(message.level);
  line.append(8 - std::string_view(word(message.level)).size(), ' ');
  line += std::string(message.process) + ": ";
  bool indent = false;  // the spaces behind a line break go with it
  for (const char c : message.text) {
    if (c == '\n') {
      line += "; ";
      indent = true;
    } else if (c != ' ' || !indent) {
      indent = false;
      line += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
  }
  return line;
}

std::string json_line(const Message& message, Fields fields) {
  nlohmann::ordered_json line = {{"time", stamp(message.time)},
                                 {"level", word(message.level)},
                                 {"process", message.process},
                                 {"kind", message.kind},
                                 {"message", message.text}};
  for (const Field& field : fields) {
    std::visit([&](const auto& value) { line[std::string(field.name)] = value; }, field.value);
  }
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace stepwright::log

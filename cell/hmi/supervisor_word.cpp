#include "cell/hmi/supervisor_word.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

namespace stepwright::hmi {
namespace {

using nlohmann::json;

// In these nobody but an operator brings the supervisor's own program back.
constexpr std::array<std::string_view, 4> kAtRest = {"ready", "held", "done", "safe"};

std::string text_of(const json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::string at_work(const std::string& document, bool alive, const std::string& running) {
  // The two members that count lie at the top: what is deep is not kept.
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth < 2; };
  const json read = json::parse(document, shallow, /*allow_exceptions=*/false);
  if (!read.is_object()) return {};
  const std::string phase = text_of(read, "phase");
  if (phase.empty() || std::find(kAtRest.begin(), kAtRest.end(), phase) != kAtRest.end()) return {};
  if (alive) return "its run is in the phase '" + phase + "'";
  if (!running.empty() && text_of(read, "program_digest") == running)
    return "its plan runs, and it goes on with it when it is back";
  return {};
}

}  // namespace stepwright::hmi

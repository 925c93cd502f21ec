#include "programs/supervisor/operator_request.h"

#include <nlohmann/json.hpp>

namespace stepwright::supervisor_program {

result::Result<OperatorRequest> parse_operator_request(const std::string& text) {
  const auto refused =
      result::fail("X0005", {}, "this is no operator request",
                   R"_(for example {"request": "change", "fluent": "(demand c1)", "value": 8})_");
  const auto request = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!request.is_object()) return refused;
  const auto kind = request.find("request");
  if (kind == request.end()) return refused;
  if (*kind == "abort") return AbortRequest{};
  const auto goal = request.find("goal");
  if (*kind == "goal" && goal != request.end() && goal->is_string())
    return GoalRequest{goal->get<std::string>()};
  const auto fluent = request.find("fluent");
  const auto value = request.find("value");
  const bool complete = *kind == "change" && fluent != request.end() && fluent->is_string() &&
                        value != request.end() && value->is_number();
  if (!complete) return refused;
  return ChangeRequest{fluent->get<std::string>(), value->get<double>()};
}

}  // namespace stepwright::supervisor_program

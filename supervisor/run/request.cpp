#include "programs/supervisor/operator_request.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace stepwright::supervisor_program {
namespace {

using nlohmann::json;

constexpr std::size_t kMostCorners = 64;
constexpr std::uint32_t kMostLoad = 1'000'000;

std::optional<std::string> text(const json& request, const char* name) {
  const auto found = request.find(name);
  if (found == request.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

std::optional<fleet::OrderChange> order(const json& request) {
  const auto name = text(request, "name");
  const auto from = text(request, "from");
  const auto to = text(request, "to");
  const auto amount = request.find("amount");
  const bool counted =
      amount == request.end() || (amount->is_number_unsigned() && amount->get<std::uint64_t>() <= kMostLoad);
  if (!name || !from || !to || !counted) return std::nullopt;
  return fleet::OrderChange{*name, *from, *to, amount == request.end() ? 1U : amount->get<std::uint32_t>()};
}

std::optional<fleet::BlockChange> block(const json& request) {
  const auto name = text(request, "name");
  const auto corners = request.find("corners_m");
  if (!name || corners == request.end() || !corners->is_array() || corners->size() > kMostCorners)
    return std::nullopt;
  std::vector<geometry::Point> points;
  for (const json& corner : *corners) {
    const bool pair =
        corner.is_array() && corner.size() == 2 && corner[0].is_number() && corner[1].is_number();
    if (!pair) return std::nullopt;
    points.push_back({corner[0].get<double>(), corner[1].get<double>()});
  }
  auto area = geometry::ConvexPolygon::hull(points);
  if (!area) return std::nullopt;
  return fleet::BlockChange{{*name, *std::move(area)}};
}

// A text that may be left out; nothing if it is there and none.
std::optional<std::string> text_or_empty(const json& request, const char* name) {
  return request.contains(name) ? text(request, name) : std::optional<std::string>(std::string());
}

std::optional<OperatorRequest> goal_request(const std::string& kind, const json& request) {
  if (kind == "goal") {
    if (auto goal = text(request, "goal")) return OperatorRequest(GoalRequest{*std::move(goal)});
  }
  auto goal = text_or_empty(request, "goal");
  auto id = text_or_empty(request, "id");
  if (kind == "start" && goal) return OperatorRequest(StartRequest{*std::move(goal)});
  if (kind == "what_if" && goal && id)
    return OperatorRequest(WhatIfRequest{*std::move(id), *std::move(goal)});
  if (kind == "cancel_what_if" && id) return OperatorRequest(CancelWhatIfRequest{*std::move(id)});
  return std::nullopt;
}

std::optional<OperatorRequest> fleet_request(const std::string& kind, const json& request) {
  if (kind == "order") {
    if (auto asked = order(request)) return OperatorRequest(fleet::FleetChange(*std::move(asked)));
  }
  if (kind == "block") {
    if (auto asked = block(request)) return OperatorRequest(fleet::FleetChange(*std::move(asked)));
  }
  if (kind == "unblock") {
    if (auto name = text(request, "name"))
      return OperatorRequest(fleet::FleetChange(fleet::UnblockChange{*std::move(name)}));
  }
  if (kind == "return") {
    if (auto vehicle = text(request, "vehicle"))
      return OperatorRequest(fleet::FleetChange(fleet::ReturnChange{*std::move(vehicle)}));
  }
  return std::nullopt;
}

}  // namespace

result::Result<OperatorRequest> parse_operator_request(const std::string& request_text) {
  const auto refused =
      result::fail("X0005", {}, "this is no operator request",
                   R"_(for example {"request": "change", "fluent": "(demand c1)", "value": 8})_");
  const auto request = json::parse(request_text, nullptr, /*allow_exceptions=*/false);
  if (!request.is_object()) return refused;
  const auto kind = text(request, "request");
  if (!kind) return refused;
  if (*kind == "abort") return AbortRequest{};
  if (*kind == "hold") return HoldRequest{};
  if (*kind == "resume") return ResumeRequest{};
  if (auto asked = goal_request(*kind, request)) return *std::move(asked);
  if (auto asked = fleet_request(*kind, request)) return *std::move(asked);
  const auto fluent = text(request, "fluent");
  const auto value = request.find("value");
  const bool complete = *kind == "change" && fluent && value != request.end() && value->is_number();
  if (!complete) return refused;
  return ChangeRequest{*fluent, value->get<double>()};
}

}  // namespace stepwright::supervisor_program

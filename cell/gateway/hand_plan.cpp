#include "cell/gateway/hand_plan.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "runtime/ground/files/files.h"

namespace stepwright::gateway {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxActions = 10'000;
constexpr std::uint64_t kLastRegister = 65'535 - 4;  // five registers from there on

// A number that is there and is one; whatever else somebody wrote is none.
std::optional<std::uint64_t> count_of(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::uint64_t>();
}

// The action with this number, or what is wrong with it.
tl::expected<remote::HandAction, std::string> action_of(const json& entry, std::size_t number) {
  const std::string name = "action " + std::to_string(number);
  const bool whole = entry.is_object() && count_of(entry, "number") == number && entry.contains("after") &&
                     entry["after"].is_array() && number <= kMaxActions;
  const bool named = whole && (!entry.contains("action") || entry["action"].is_string());
  if (!named) return tl::unexpected(name + " is not whole");
  remote::HandAction action;
  if (entry.contains("action")) action.text = entry["action"].get<std::string>();
  for (const json& before : entry["after"]) {
    const std::uint64_t other = before.is_number_unsigned() ? before.get<std::uint64_t>() : 0;
    if (other == 0 || other >= number) return tl::unexpected(name + " comes after one that is not before it");
    action.before.push_back(static_cast<std::size_t>(other));
  }
  return action;
}

}  // namespace

result::Result<HandPlan> read_hand_plan(const std::filesystem::path& file) {
  const auto fail = [&](std::string message) {
    return result::fail("C0566", {file.string(), 0, 0}, std::move(message),
                        "`stepwright translate --handshake` writes it");
  };
  const auto text = files::read_file(file.string());
  if (!text) return fail("the table of the plan cannot be read: " + text.error().front().message);
  const json table = json::parse(*text, nullptr, false);
  if (!table.is_object() || !table.contains("actions") || !table["actions"].is_array())
    return fail("this is no table of a plan");
  const auto registers = count_of(table, "registers");
  if (!registers || *registers > kLastRegister) return fail("`registers` is no address of five registers");
  HandPlan plan;
  plan.registers = static_cast<std::uint16_t>(*registers);
  for (const json& entry : table["actions"]) {
    auto action = action_of(entry, plan.actions.size() + 1);
    if (!action) return fail(action.error());
    plan.actions.push_back(std::move(*action));
  }
  if (plan.actions.empty()) return fail("the plan has no actions");
  return plan;
}

}  // namespace stepwright::gateway

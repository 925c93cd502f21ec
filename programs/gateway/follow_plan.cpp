#include "programs/gateway/follow_plan.h"

#include <poll.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stepwright::gateway {
namespace {

using remote::HandState;
using result::ExitCode;

constexpr std::size_t kMaxActions = 10'000;

}  // namespace

result::Result<HandPlan> read_hand_plan(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  const auto fail = [&](std::string message) {
    return result::fail("C0545", {file.string(), 0, 0}, std::move(message),
                        "`stepwright translate --handshake` writes it");
  };
  const auto json = nlohmann::json::parse(text.str(), nullptr, false);
  if (!json.is_object() || !json.contains("actions") || !json["actions"].is_array() ||
      !json.contains("registers") || !json["registers"].is_number_unsigned())
    return fail("this is no table of a plan");
  HandPlan plan;
  plan.registers = static_cast<std::uint16_t>(json["registers"].get<std::uint64_t>() & 0xFFFF);
  for (const auto& each : json["actions"]) {
    const std::size_t number = plan.actions.size() + 1;
    remote::HandAction action;
    const bool whole = each.is_object() && each.value("number", std::size_t{0}) == number &&
                       each.contains("after") && each["after"].is_array();
    if (!whole || number > kMaxActions) return fail("action " + std::to_string(number) + " is not whole");
    action.text = each.value("action", std::string());
    for (const auto& before : each["after"]) {
      const std::size_t other = before.is_number_unsigned() ? before.get<std::size_t>() : 0;
      if (other == 0 || other >= number)
        return fail("action " + std::to_string(number) + " comes after one that is not before it");
      action.before.push_back(other);
    }
    plan.actions.push_back(std::move(action));
  }
  if (plan.actions.empty()) return fail("the plan has no actions");
  return plan;
}

ExitCode follow_plan(const config::CellConfig& config, const HandPlan& plan, remote::RegisterLine& line,
                     log::Logger& log, const process::StopSignal& stop) {
  remote::HandLoaded follower(line, plan.registers, plan.actions);
  log.info("follows",
           "follows the plan of " + std::to_string(plan.actions.size()) + " actions on " + line.name());
  static_cast<void>(line.reopen());
  bool answers = true;
  while (!stop.came() && follower.state() == HandState::UnderWay) {
    auto news = follower.turn();
    if (!news && answers) log.warning("controller", result::to_string(news.error()));
    if (news && !answers) log.info("controller", "the controller answers again");
    answers = news.has_value();
    if (news) {
      // The end is told however much was told before.
      const char* const kind = follower.state() == HandState::UnderWay ? "plan" : "outcome";
      for (const std::string& each : *news) log.info(kind, each);
    }
    log.tick();
    pollfd wait{stop.descriptor(), POLLIN, 0};
    poll(&wait, 1, static_cast<int>(config.controller.exchange.count()));
  }
  if (follower.state() == HandState::UnderWay) {
    if (auto withdrawn = follower.withdraw(); !withdrawn)
      log.warning("controller", result::to_string(withdrawn.error()));
    log.info("ends",
             "nothing is granted any more; " + std::to_string(follower.started()) + " actions were started");
    return ExitCode::Done;
  }
  return follower.state() == HandState::Done ? ExitCode::Done : ExitCode::RuntimeFault;
}

}  // namespace stepwright::gateway

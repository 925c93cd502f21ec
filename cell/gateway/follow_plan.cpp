#include "cell/gateway/follow_plan.h"
#include "runtime/ground/result/counted.h"

#include <poll.h>

namespace stepwright::gateway {
namespace {

using remote::HandState;
using result::ExitCode;

}  // namespace

ExitCode follow_plan(const config::CellConfig& config, const HandPlan& plan, remote::RegisterLine& line,
                     log::Logger& log, const process::StopSignal& stop,
                     const std::function<void(const FollowStatus&)>& meanwhile) {
  remote::HandLoaded follower(line, plan.registers, plan.actions);
  log.info("follows", "follows the plan of " + result::counted(plan.actions.size(), "action", "actions") +
                          " on " + line.name());
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
    meanwhile({answers, follower.started()});
    pollfd wait{stop.descriptor(), POLLIN, 0};
    poll(&wait, 1, static_cast<int>(config.controller.exchange.count()));
  }
  if (follower.state() == HandState::UnderWay) {
    if (auto withdrawn = follower.withdraw(); !withdrawn)
      log.warning("controller", result::to_string(withdrawn.error()));
    log.info("ends", "nothing is granted any more; " +
                         result::counted(follower.started(), "action was", "actions were") + " started");
    return ExitCode::Done;
  }
  return follower.state() == HandState::Done ? ExitCode::Done : ExitCode::RuntimeFault;
}

}  // namespace stepwright::gateway

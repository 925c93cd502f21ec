#include "cell/gateway/gateway_metrics.h"

#include <array>

#include "runtime/metrics/exposition.h"
#include "runtime/metrics/metrics_text.h"

namespace stepwright::gateway {

void GatewayFigures::publish(const host::RuntimeStatus& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
}

void GatewayFigures::publish(const remote::RemoteFigures& line) {
  const std::lock_guard lock(mutex_);
  line_ = {line.contact, line.repeated, line.losses};
}

void GatewayFigures::publish(const FollowStatus& follow, std::size_t actions) {
  const std::lock_guard lock(mutex_);
  line_.contact = follow.answers;
  plan_ = {actions, follow.started};
}

std::string GatewayFigures::text() const {
  std::array<metrics::RuntimeMetrics, 1> runtime;
  Line line;
  std::optional<Plan> plan;
  {
    const std::lock_guard lock(mutex_);
    runtime[0] = {runtime_, line_.contact && status_.has_value(), status_};
    line = line_;
    plan = plan_;
  }
  metrics::Exposition text;
  const std::string own = metrics::label("runtime", runtime_);
  text.figure("stepwright_controller_contact", "gauge", "1 if the controller answers.", own,
              line.contact ? 1.0 : 0.0);
  if (plan) {
    text.figure("stepwright_controller_plan_actions", "gauge", "Actions of the plan that is followed.", own,
                static_cast<double>(plan->actions));
    text.figure("stepwright_controller_plan_actions_started", "gauge", "Those that have started.", own,
                static_cast<double>(plan->started));
    return text.take();
  }
  text.figure("stepwright_controller_repeated_requests_total", "counter", "Requests that were sent again.",
              own, static_cast<double>(line.repeated));
  text.figure("stepwright_controller_losses_total", "counter", "How often the controller was lost.", own,
              static_cast<double>(line.losses));
  return metrics::metrics_text(runtime) + text.take();
}

}  // namespace stepwright::gateway

#include "supervisor/executive/planning_job.h"

#include <utility>

namespace stepwright::executive {

PlanningJob::PlanningJob(const PlanningService& planning, PlanRequest request) {
  request.cancel = &cancelled_;
  future_ = std::async(std::launch::async,
                       [&planning, request = std::move(request)] { return planning.prepare(request); });
}

PlanningJob::~PlanningJob() {
  cancel();
  if (future_.valid()) future_.wait();
}

bool PlanningJob::wait(std::chrono::milliseconds timeout) {
  return future_.wait_for(timeout) == std::future_status::ready;
}

}  // namespace stepwright::executive

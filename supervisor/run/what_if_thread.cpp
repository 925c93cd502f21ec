#include "supervisor/run/what_if_thread.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "runtime/ground/result/last_barrier.h"
#include "runtime/service/answer_codes.h"
#include "supervisor/run/internal/record_json.h"

namespace stepwright::run {
namespace {

using internal::json;

// Of the thread that searches; whatever plans for the plant comes first.
constexpr int kNice = 10;

json answer_of(const WhatIfAsked& asked, const char* state) {
  return {{"id", asked.id}, {"goal", asked.goal}, {"state", state}, {"ahead", asked.ahead}};
}

}  // namespace

WhatIfThread::~WhatIfThread() {
  cancel_ = true;
  if (thread_.joinable()) thread_.join();
}

result::Result<void> WhatIfThread::ask(const WhatIfAsked& asked, Plan plan) {
  if (asked.id.size() > kMaxWhatIfId)
    return result::fail("X0005", {}, "the id of the question is too long",
                        "up to " + std::to_string(kMaxWhatIfId) + " bytes are possible");
  const std::lock_guard turn(turn_);
  if (planning_)
    return result::fail(service::kNotNow, {}, "another what-if is being planned",
                        "wait for it, or cancel it");
  if (thread_.joinable()) thread_.join();  // it says its last word
  cancel_ = false;
  planning_ = true;
  publish(internal::text_of(answer_of(asked, "planning")));
  {
    const std::lock_guard lock(mutex_);
    id_ = asked.id;
  }
  thread_ = std::thread([this, asked, plan = std::move(plan)] {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);  // of this thread alone
    work(asked, plan);
  });
  return {};
}

// A question that is too much for this machine ends as a question, not as the run.
void WhatIfThread::work(const WhatIfAsked& asked, const Plan& plan) {
  const auto began = std::chrono::steady_clock::now();
  json told = answer_of(asked, "failed");
  if (const auto thrown = result::thrown_by([&] { told.update(json::parse(plan(cancel_))); }))
    told["reason"] = *thrown;
  told["wall_ms"] =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  planning_ = false;  // who has read the answer may ask again
  publish(internal::text_of(told));
}

result::Result<void> WhatIfThread::cancel(const std::string& id) {
  const std::lock_guard turn(turn_);
  const std::lock_guard lock(mutex_);
  if (!planning_ || (!id.empty() && id != id_))
    return result::fail(service::kNotNow, {}, "no such what-if is being planned", "it may have just ended");
  cancel_ = true;
  return {};
}

std::string WhatIfThread::answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

std::uint64_t WhatIfThread::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

void WhatIfThread::publish(std::string answer) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(answer);
  ++revision_;
}

}  // namespace stepwright::run

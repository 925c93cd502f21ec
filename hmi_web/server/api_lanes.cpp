#include "hmi_web/server/api_lanes.h"

#include <utility>

#include "runtime/ground/result/last_barrier.h"

namespace stepwright::server {
namespace {

std::size_t index_of(api::Lane lane) {
  switch (lane) {
    case api::Lane::Password:
      return 1;
    case api::Lane::Runtime:
      return 2;
    case api::Lane::Records:
      return 3;
    case api::Lane::Stop:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

ApiLanes::ApiLanes() {
  for (Worker& worker : workers_) worker.thread = std::thread([&worker] { run(worker); });
}

ApiLanes::~ApiLanes() {
  for (Worker& worker : workers_) {
    {
      const std::lock_guard lock(worker.mutex);
      worker.stopping = true;
    }
    worker.signal.notify_one();
  }
  for (Worker& worker : workers_) worker.thread.join();
}

bool ApiLanes::post(api::Lane lane, std::function<void()> job) {
  Worker& worker = workers_[index_of(lane)];
  {
    const std::lock_guard lock(worker.mutex);
    if (worker.jobs.size() >= kMostWaiting) return false;
    worker.jobs.push_back(std::move(job));
  }
  worker.signal.notify_one();
  return true;
}

void ApiLanes::run(Worker& worker) {
  std::unique_lock lock(worker.mutex);
  while (true) {
    worker.signal.wait(lock, [&] { return worker.stopping || !worker.jobs.empty(); });
    if (worker.stopping) return;
    const std::function<void()> job = std::move(worker.jobs.front());
    worker.jobs.pop_front();
    lock.unlock();
    // Whoever posted it answers for what it throws; what is left would end the server.
    static_cast<void>(result::thrown_by(job));
    lock.lock();
  }
}

}  // namespace stepwright::server

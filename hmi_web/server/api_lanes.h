#pragma once

// A thread for each lane of the API, so that a slow request (a password, a runtime that does not answer)
// holds up neither the pages nor the other lanes.
//
//   ApiLanes lanes;
//   if (!lanes.post(api::Lane::Quick, [=] { ... })) refuse(503);
//
// Threads: `post` from any. Ends when the job that is under way has ended; the others are dropped.

#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "hmi_web/api/route.h"

namespace stepwright::server {

class ApiLanes {
 public:
  static constexpr std::size_t kMostWaiting = 16;  // in one lane

  ApiLanes();
  ~ApiLanes();
  ApiLanes(const ApiLanes&) = delete;
  ApiLanes& operator=(const ApiLanes&) = delete;

  // False if too many wait already.
  bool post(api::Lane lane, std::function<void()> job);

 private:
  struct Worker {
    std::mutex mutex;
    std::condition_variable signal;
    std::deque<std::function<void()>> jobs;  // guarded by mutex
    bool stopping = false;                   // guarded by mutex
    std::thread thread;
  };
  static void run(Worker& worker);

  std::array<Worker, 5> workers_;
};

}  // namespace stepwright::server

#pragma once

// Stands in for link and runtime: answers every request with what the test says and publishes a status every
// 2 ms.

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/dds/link_endpoint.h"
#include "runtime/service/codec.h"
#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {

class FakeLink {
 public:
  using Handler = std::function<std::optional<service::Reply>(const service::Request&)>;

  FakeLink(std::uint32_t domain, Handler handler, const std::string& runtime_id = test_runtime_id(),
           const std::string& place = {}, const OnTrouble& on_trouble = {})
      : handler_(std::move(handler)),
        endpoint_(
            *LinkEndpoint::create({domain, "fake_link", runtime_id, {"127.0.0.1"}, {}, place, on_trouble})) {
    status_.incarnation = 7;
    thread_ = std::thread([this] { run(); });
  }
  ~FakeLink() {
    stop_ = true;
    thread_.join();
  }

  LinkEndpoint& endpoint() { return *endpoint_; }
  void set_connected(bool connected) { connected_ = connected; }
  template <typename Change>
  void change_status(Change change) {
    const std::scoped_lock lock(mutex_);
    change(status_);
  }

 private:
  void run() {
    while (!stop_) {
      endpoint_->clear();
      while (auto bytes = endpoint_->take_request()) {
        const auto request = std::get<service::Request>(service::decode(*bytes).value());
        auto reply = handler_(request);
        if (!reply) continue;
        reply->client = request.client;
        reply->id = request.id;
        endpoint_->publish_reply(*reply);
      }
      {
        const std::scoped_lock lock(mutex_);
        endpoint_->publish_status(status_, connected_);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  Handler handler_;
  std::mutex mutex_;
  RuntimeStatus status_;
  std::atomic<bool> connected_{true};
  std::atomic<bool> stop_{false};
  std::unique_ptr<LinkEndpoint> endpoint_;
  std::thread thread_;
};

}  // namespace stepwright::dds

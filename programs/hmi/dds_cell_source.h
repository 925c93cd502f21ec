#pragma once

// The cell behind Fast DDS: the runtime through the link process, and the supervisor's plan document.
//
// Thread rule: as server::CellSource, one thread. `observe` blocks only when another program runs than the
// one last fetched, at most for dds::kRequestTimeout.

#include <chrono>
#include <memory>
#include <string>

#include "cell/config/cell_config.h"
#include "hmi_web/server/cell_source.h"
#include "programs/hmi/local_runtime.h"
#include "programs/hmi/running_program.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/dds/runtime_client.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"

namespace stepwright::hmi {

class DdsCellSource : public server::CellSource {
 public:
  // Joins the cell's domain; nobody needs to be there yet. The log must outlive it. Fails with D0005.
  [[nodiscard]] static result::Result<std::unique_ptr<DdsCellSource>> connect(
      const config::CellConfig& config, log::Logger& log);

  server::Observation observe() override;
  void wait_for_image(std::chrono::milliseconds timeout) override {
    static_cast<void>(runtime_->wait_snapshot(timeout));  // looks in any case
  }
  // Its figures may be asked for by any thread.
  const dds::RuntimeClient& runtime() const { return *runtime_; }

  // For whoever acts on the cell; any thread.
  dds::RuntimeClient& client() { return *runtime_; }
  dds::PlanSubscriber& plans() { return *plans_; }
  const RunningProgram& running() const { return running_; }

 private:
  DdsCellSource(std::unique_ptr<dds::RuntimeClient> runtime, std::unique_ptr<dds::PlanSubscriber> plans,
                const config::CellConfig& config, log::Logger& log)
      : runtime_(std::move(runtime)),
        plans_(std::move(plans)),
        devices_(config.modbus_client),
        local_(config.socket_path()),
        log_(log) {}

  // True if it had to ask, which takes its time.
  bool fetch_program(const std::string& digest);

  std::unique_ptr<dds::RuntimeClient> runtime_;
  std::unique_ptr<dds::PlanSubscriber> plans_;
  modbus::client::ClientSettings devices_;
  LocalRuntime local_;
  log::Logger& log_;
  RunningProgram running_;
  std::shared_ptr<const server::ProgramLayout> layout_;  // of the program with its digest; shared with views
  std::chrono::steady_clock::time_point next_fetch_{};   // a fetch that failed is not repeated at once
  std::uint64_t images_of_before_ = 0;                   // that had come when the runtime was last not there
  std::string tare_source_;                              // the plan document that `tare_` was read from
  server::Tare tare_;
};

}  // namespace stepwright::hmi

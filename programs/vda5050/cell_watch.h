#pragma once

// A cell over Fast DDS as a viewer has it: the image with the program that it is of, and the supervisor's
// plan document.
//
// One thread. `observe` blocks only when another program runs than the one last fetched, at most for
// dds::kRequestTimeout.
//
//   auto watch = CellWatch::connect(config, log);
//   const CellView view = (*watch)->observe();

#include <chrono>
#include <memory>
#include <string>

#include "cell/config/cell_config.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/dds/runtime_client.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/vda5050/link/fleet_publisher.h"

namespace stepwright::vda5050_link {

class CellWatch {
 public:
  // Joins the cell's domain; nobody needs to be there yet. The log must outlive it. D0004 to D0006.
  [[nodiscard]] static result::Result<std::unique_ptr<CellWatch>> connect(const config::CellConfig& config,
                                                                          log::Logger& log);
  CellView observe();

 private:
  CellWatch(std::unique_ptr<dds::RuntimeClient> runtime, std::unique_ptr<dds::PlanSubscriber> plans,
            log::Logger& log)
      : runtime_(std::move(runtime)), plans_(std::move(plans)), log_(log) {}

  void fetch_program(const std::string& digest);

  std::unique_ptr<dds::RuntimeClient> runtime_;
  std::unique_ptr<dds::PlanSubscriber> plans_;
  log::Logger& log_;
  std::shared_ptr<const reader::ProgramInfo> program_;
  std::string digest_;  // of `program_`
  std::string document_;
  std::chrono::steady_clock::time_point next_fetch_{};  // a fetch that failed is not repeated at once
};

}  // namespace stepwright::vda5050_link

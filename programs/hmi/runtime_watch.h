#pragma once

// The figures of one or more runtimes of the domain, heard over Fast DDS, for /metrics and /api/scan: the
// cell's own, and those that [hmi] metrics_of names.
//
// Threads: `metrics` and `scan` from any; nothing blocks.

#include <memory>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/api/cell_figures.h"
#include "runtime/dds/runtime_client.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"
#include "runtime/metrics/metrics_text.h"

namespace stepwright::hmi {

class RuntimeWatch final : public api::CellFigures {
 public:
  // Joins the domain once for each other runtime; nobody needs to be there yet. `own` and the log outlive it.
  // Fails with D0004 to D0006.
  [[nodiscard]] static result::Result<std::unique_ptr<RuntimeWatch>> connect(const config::CellConfig& config,
                                                                             const dds::RuntimeClient& own,
                                                                             log::Logger& log);

  std::string metrics() const;
  api::Answer scan() const override;

 private:
  struct Watched {
    std::string runtime;
    const dds::RuntimeClient* client;
  };
  std::vector<Watched> watched_;
  std::vector<std::unique_ptr<dds::RuntimeClient>> others_;
};

}  // namespace stepwright::hmi

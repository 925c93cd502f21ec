#pragma once

// The smallest mission that runs: fills the vehicle of the tank bench up to a level by one chart of two
// steps. People may want another level, by a word that the page has: {"request": "change", "fluent":
// "(level v1)", "value": 2500}. Begin a mission with a copy of this (supervisor/doc/adding_a_planner.md).
//
// Threads: as run::Mission.

#include <cstddef>
#include <optional>
#include <vector>

#include "supervisor/run/due_requests.h"
#include "supervisor/run/image_reader.h"
#include "supervisor/run/mission.h"

namespace stepwright::filling {

class FillingMission final : public run::Mission {
 public:
  // Up to so many counts of the level's transmitter.
  FillingMission(run::Controller& controller, run::MissionOptions options, int counts,
                 Observer observer = {});

 private:
  bool begin() override;
  run::Decision judge_image(std::span<const std::byte> image) override;
  bool replan(const run::Cause& cause) override;
  bool finish() override;
  bool recover_runtime() override;
  void publish(bool now) override;
  bool drives() const override { return reader_.has_value(); }
  result::Result<void> take(const run::Request& request) override;
  std::optional<run::Cause> due(double time_s) override;

  bool launch();
  bool install(const std::vector<std::byte>& program);

  struct Level {
    double at_s = 0.0;
    int counts = 0;
  };
  int counts_;
  run::DueRequests<Level> wanted_{{}};
  std::optional<run::ImageReader> reader_;  // of the program that runs
};

}  // namespace stepwright::filling

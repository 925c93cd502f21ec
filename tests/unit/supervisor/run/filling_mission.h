#pragma once

// The smallest mission that runs: fills the vehicle of the tank bench up to a level by one chart of two
// steps. supervisor/doc/adding_a_planner.md goes through it.
//
// Threads: as run::Mission.

#include <optional>
#include <vector>

#include "supervisor/run/image_reader.h"
#include "supervisor/run/mission.h"

namespace stepwright::run {

class FillingMission final : public Mission {
 public:
  // Up to so many counts of the level's transmitter.
  FillingMission(Controller& controller, int counts, Observer observer = {});

 private:
  bool begin() override;
  Decision judge_image(std::span<const std::byte> image) override;
  bool replan(const Cause& cause) override;
  bool finish() override;
  bool recover_runtime() override;
  void publish(bool now) override;
  bool drives() const override { return reader_.has_value(); }

  bool launch();

  int counts_;
  std::optional<ImageReader> reader_;  // of the program that runs
};

}  // namespace stepwright::run

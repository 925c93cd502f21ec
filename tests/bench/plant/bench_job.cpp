#include "tests/bench/plant/bench_job.h"

namespace stepwright::bench {
namespace {

constexpr int kPauseScans = 40;

// As bench_ports.h of the assemblies orders them.
constexpr core::TruthId kLevelV1{1}, kLevelA1{2}, kLevelA2{3};
constexpr core::SensorId kAtF1{0}, kAtA1{1}, kAtA2{2};

}  // namespace

void Job::go(Phase phase) {
  if (phase == Phase::Load) ++rounds_;
  phase_ = phase;
  pause_ = kPauseScans;
}

Outputs Job::next(const core::Plant& plant) {
  const double v1 = plant.truth(kLevelV1), a1 = plant.truth(kLevelA1), a2 = plant.truth(kLevelA2);
  if (a1 < 30.0) draws_a1_ = false;
  if (a2 < 30.0) draws_a2_ = false;
  Outputs out{};
  out[2] = draws_a1_;
  out[3] = draws_a2_;
  if (pause_ > 0) {
    --pause_;
    return out;
  }
  switch (phase_) {
    case Phase::Load:
      out[0] = v1 < 80.0;
      if (!out[0]) go(Phase::ToA1);
      break;
    case Phase::ToA1:
      out[4] = plant.sensor(kAtA1) == 0;
      if (!out[4]) go(Phase::UnloadA1);
      break;
    case Phase::UnloadA1:
      out[1] = a1 < 60.0 && v1 > 20.0;
      if (out[1]) break;
      draws_a1_ = true;
      go(Phase::ToA2);
      break;
    case Phase::ToA2:
      out[5] = plant.sensor(kAtA2) == 0;
      if (!out[5]) go(Phase::UnloadA2);
      break;
    case Phase::UnloadA2:
      out[1] = a2 < 60.0 && v1 > 20.0;
      if (out[1]) break;
      draws_a2_ = true;
      go(Phase::ToF1);
      break;
    case Phase::ToF1:
      out[4] = plant.sensor(kAtF1) == 0;
      if (!out[4]) go(Phase::Load);
      break;
  }
  return out;
}

void operate(const Outputs& outputs, core::Plant& plant) {
  for (std::uint32_t i = 0; i < outputs.size(); ++i) plant.set_actuator(core::ActuatorId(i), outputs[i]);
}

}  // namespace stepwright::bench

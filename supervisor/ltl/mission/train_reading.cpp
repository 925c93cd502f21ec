#include "supervisor/ltl/mission/train_reading.h"

#include <algorithm>
#include <numbers>
#include <string>

namespace stepwright::ltl {
namespace {

constexpr double kCountRad = std::numbers::pi / 18'000.0;  // 0.01 degrees

}  // namespace

TrainState TrainReading::standing_state() const {
  TrainState stands{};
  stands[kTrainX] = pose.x_m;
  stands[kTrainY] = pose.y_m;
  stands[kTrainHeading] = pose.heading_rad;
  stands[kTrainLock] = 0.0;  // the wheel turns before the train moves
  double heading = pose.heading_rad;
  for (std::size_t k = 0; k < std::min(trailers, hitches_rad.size()) && k < kMostTrailers; ++k) {
    heading -= hitches_rad[k];
    stands[kTrainTrailer + k] = heading;
  }
  return stands;
}

result::Result<TrainReader> TrainReader::create(std::span<const std::byte> container,
                                                const TrainProgram& program, std::size_t hitches) {
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  result::Diagnostics missing;
  const auto lack = [&](const std::string& what) {
    missing.push_back({"X0002", result::Severity::Error, {}, "the program has no " + what, {}});
  };
  const auto find = [&](const std::string& path) {
    const reader::Variable* found = info->find(path);
    if (found == nullptr) lack("variable '" + path + "'");
    return found == nullptr ? reader::Variable{} : *found;
  };
  TrainReader made;
  const std::string vehicle = "vehicle_train.";
  made.x_ = find(vehicle + "X");
  made.y_ = find(vehicle + "Y");
  made.heading_ = find(vehicle + "Heading");
  made.speed_ = find(vehicle + "Speed");
  made.lock_ = find(vehicle + "Lock");
  made.error_ = find(vehicle + "ErrorID");
  made.arc_ = find("arc");
  made.trailers_ = find("trailers");
  made.state_ = find(kTaskState);
  made.verdict_ = find(kTaskVerdict);
  made.standing_ = find("standing");
  made.estop_ok_ = find("estop_ok");
  made.way_free_ = find("way_free");
  for (std::size_t k = 0; k < hitches; ++k) made.hitches_.push_back(find("hitch_" + std::to_string(k + 1)));
  const reader::ChartInfo* chart = info->chart(kTaskChart);
  if (chart == nullptr || chart->steps.size() != program.steps.size())
    lack(std::string("chart '") + kTaskChart + "' of " + std::to_string(program.steps.size()) + " steps");
  else
    for (const reader::StepInfo& step : chart->steps) made.steps_.push_back(step.active);
  if (!missing.empty()) return tl::unexpected(std::move(missing));
  return made;
}

TrainReading TrainReader::read(std::span<const std::byte> image) const {
  const auto number = [&](const reader::Variable& variable) { return reader::read_number(variable, image); };
  TrainReading now;
  now.pose = {number(x_), number(y_), number(heading_)};
  now.speed_m_s = number(speed_);
  now.lock_rad = number(lock_);
  now.arc_m = number(arc_);
  for (const reader::Variable& hitch : hitches_) now.hitches_rad.push_back(kCountRad * number(hitch));
  now.trailers = static_cast<std::size_t>(std::max(0.0, number(trailers_)));
  now.error = static_cast<std::uint32_t>(number(error_));
  now.state = static_cast<std::uint32_t>(number(state_));
  now.verdict = static_cast<Verdict>(static_cast<std::uint8_t>(std::clamp(number(verdict_), 0.0, 2.0)));
  now.standing = number(standing_) != 0.0;
  now.estop_ok = number(estop_ok_) != 0.0;
  now.way_free = number(way_free_) != 0.0;
  for (std::size_t k = 0; k < steps_.size(); ++k)
    if (number(steps_[k]) != 0.0) now.step = k;
  return now;
}

}  // namespace stepwright::ltl

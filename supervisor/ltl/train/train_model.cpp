#include "supervisor/ltl/train/train_model.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr double kTouch_m = 1e-9;  // less than that is no overlap

void require(result::Diagnostics& problems, bool holds, const std::string& message) {
  if (holds) return;
  result::Diagnostic problem;
  problem.code = "L0301";
  problem.message = message;
  problem.hint = "supervisor/doc/ltl.md has the figures of a train";
  problems.push_back(std::move(problem));
}

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

}  // namespace

result::Result<void> validate(const TrainModel& model) {
  result::Diagnostics problems;
  require(problems, model.trailers <= kMostTrailers,
          "a train has at most " + std::to_string(kMostTrailers) + " trailers");
  const std::pair<const char*, double> lengths[] = {
      {"hitch_m", model.hitch_m},
      {"wheelbase_m", model.wheelbase_m},
      {"length_m", model.length_m},
      {"width_m", model.width_m},
      {"spacing_m", model.spacing_m},
      {"most_speed_m_s", model.most_speed_m_s},
      {"most_acceleration_m_s2", model.most_acceleration_m_s2},
      {"most_lock_rate_rad_s", model.most_lock_rate_rad_s},
  };
  for (const auto& [name, value] : lengths)
    require(problems, positive(value), std::string("train: ") + name + " must be greater than 0");
  require(problems, positive(model.most_hitch_rad), "train: most_hitch_rad must be greater than 0");
  require(problems, positive(model.most_lock_rad) && model.most_lock_rad < 1.5,
          "train: most_lock_rad must lie between 0 and 1.5");
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

TrainState standing_at(const TrainModel& model, const geometry::Pose& pose) {
  TrainState state{};
  state[kTrainX] = pose.x_m;
  state[kTrainY] = pose.y_m;
  state[kTrainHeading] = pose.heading_rad;
  for (std::size_t k = 0; k < model.trailers; ++k) state[kTrainTrailer + k] = pose.heading_rad;
  return state;
}

TrainState rate(const TrainModel& model, const TrainState& state, const TrainControl& control) {
  TrainState change{};
  const double speed = state[kTrainSpeed];
  change[kTrainX] = speed * std::cos(state[kTrainHeading]);
  change[kTrainY] = speed * std::sin(state[kTrainHeading]);
  change[kTrainHeading] = speed * std::tan(state[kTrainLock]) / model.wheelbase_m;
  change[kTrainSpeed] = control.acceleration_m_s2;
  change[kTrainLock] = control.lock_rate_rad_s;
  double pulled_m_s = speed;  // of the link in front, along its own heading
  double front_rad = state[kTrainHeading];
  for (std::size_t k = 0; k < model.trailers; ++k) {
    const double heading = state[kTrainTrailer + k];
    const double sine = model.reading == HitchReading::Pulled ? std::sin(front_rad - heading)
                                                              : std::sin(front_rad) - std::sin(heading);
    change[kTrainTrailer + k] = pulled_m_s / model.hitch_m * sine;
    pulled_m_s *= std::cos(front_rad - heading);
    front_rad = heading;
  }
  return change;
}

LinkBoxes link_boxes(const TrainModel& model, const TrainState& state) {
  LinkBoxes boxes;
  geometry::Point middle{state[kTrainX], state[kTrainY]};
  boxes[0] = {middle, {std::cos(state[kTrainHeading]), std::sin(state[kTrainHeading])}};
  for (std::size_t k = 0; k < model.trailers; ++k) {
    const double heading = state[kTrainTrailer + k];
    const geometry::Point ahead{std::cos(heading), std::sin(heading)};
    middle = middle - model.spacing_m * ahead;
    boxes[k + 1] = {middle, ahead};
  }
  return boxes;
}

bool overlaps(const TrainModel& model, const LinkBox& a, const LinkBox& b) {
  const geometry::Point apart = b.middle - a.middle;
  const double length = 0.5 * model.length_m;
  const double width = 0.5 * model.width_m;
  const double along = std::abs(dot(a.ahead, b.ahead));
  const double across = std::abs(cross(a.ahead, b.ahead));
  const double ahead = length + length * along + width * across - kTouch_m;
  const double aside = width + length * across + width * along - kTouch_m;
  return std::abs(dot(apart, a.ahead)) < ahead && std::abs(cross(apart, a.ahead)) < aside &&
         std::abs(dot(apart, b.ahead)) < ahead && std::abs(cross(apart, b.ahead)) < aside;
}

bool meets_itself(const TrainModel& model, const LinkBoxes& boxes) {
  const double reach = std::hypot(model.length_m, model.width_m);
  const double least = model.most_hitch_rad < std::numbers::pi ? std::cos(model.most_hitch_rad) : -2.0;
  for (std::size_t i = 0; i < model.links(); ++i) {
    if (i + 1 < model.links() && dot(boxes[i].ahead, boxes[i + 1].ahead) < least) return true;
    for (std::size_t k = i + 2; k < model.links(); ++k) {
      const geometry::Point apart = boxes[k].middle - boxes[i].middle;
      if (dot(apart, apart) < reach * reach && overlaps(model, boxes[i], boxes[k])) return true;
    }
  }
  return false;
}

}  // namespace stepwright::ltl

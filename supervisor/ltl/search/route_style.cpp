#include "supervisor/ltl/search/route_style.h"

#include <algorithm>
#include <cmath>

namespace stepwright::ltl {

namespace {

constexpr double kSmoothing = 0.9;  // of a row of trailers, which cuts turns: more than sqrt(2 / pi), for
                                    // turns that are several ones shortly after each other
constexpr double kBeside_m = 0.05;  // of a link, as walls are looked at

}  // namespace

DriveStyle plain_style(const TrainModel& model) {
  return {.lookahead_m = model.trailers == 0 ? 0.8 : 1.0, .tightest_m = tightest_m(model), .cruise_m_s = 1.6};
}

DriveStyle style_by_chance(const TrainModel& model, std::mt19937_64& dice) {
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  DriveStyle style = plain_style(model);
  style.lookahead_m *= 0.7 + 1.6 * chance(dice);
  style.tightest_m = std::max(least_turn_m(model), style.tightest_m * (0.6 + 1.2 * chance(dice)));
  style.cruise_m_s = 0.8 + 1.2 * chance(dice);
  style.side = static_cast<int>(3.0 * chance(dice)) - 1;
  return style;
}

RouteQuery route_query(const TrainModel& model, const DriveMark& from, double turn_m, double room,
                       double noise, std::uint64_t seed, const Stop& stop) {
  return {.at = {from.state[kTrainX], from.state[kTrainY]},
          .heading_rad = from.state[kTrainHeading],
          .state = from.task,
          .turn_m = turn_m,
          .trail_m = room * kSmoothing * model.hitch_m * std::sqrt(static_cast<double>(model.trailers)),
          .half_m = 0.5 * model.width_m + kBeside_m,
          .noise = noise,
          .seed = seed,
          .stop = stop};
}

}  // namespace stepwright::ltl

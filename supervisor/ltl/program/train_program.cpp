#include "supervisor/ltl/program/train_program.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "supervisor/ltl/monitor/monitor_block.h"
#include "supervisor/ltl/program/train_chart.h"
#include "supervisor/ltl/program/train_texts.h"
#include "supervisor/vehicle/data_tables.h"
#include "supervisor/vehicle/news_chart.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::ltl {
namespace {

constexpr const char* kTask = "train";
constexpr double kFarthest_m = 320.0;  // navigation counts centimetres in 16 bits
constexpr std::size_t kMostSamples = 1'000'000;

class ProjectWriter {
 public:
  ProjectWriter(const TrainProgramInput& input, const TrainTerminals& terminals,
                const TrainProgramOptions& options)
      : input_(input), terminals_(terminals), options_(options) {}

  result::Result<TrainProgram> write() {
    auto monitor = monitor_block(input_.watch->automaton, {.name = watch_type(*input_.watch),
                                                           .inputs = place_names(input_.places),
                                                           .about = input_.watch->text});
    if (!monitor) return result::forward(monitor);
    made_.monitor = *std::move(monitor);
    graphic::Project& project = made_.project;
    project.name = kTask;
    project.globals = train_globals(input_, terminals_, options_);
    std::string path;
    if (input_.way != nullptr && !input_.way->samples.empty()) {
      project.globals.push_back(vehicle::path_table("train", input_.way->samples, "the way of the train"));
      path = project.globals.back().name;
    }
    // The chart sees the places of its own scan, drives what it permits.
    vehicle::add_text(project, kTask, "sensing", train_sensing(input_, options_),
                      train_sensing_blocks(input_));
    TrainChart chart = train_chart(input_, options_);
    made_.steps = std::move(chart.steps);
    vehicle::add_chart(project, kTask, kTaskChart, std::move(chart.chart));
    vehicle::add_text(project, kTask, "driving", train_driving(options_, path),
                      train_driving_blocks(options_, path));
    vehicle::add_chart(project, kTask, "news", vehicle::news_chart(options_.news_every));
    project.tasks = {{kTask, options_.interval_us, 0}};
    return std::move(made_);
  }

 private:
  const TrainProgramInput& input_;
  const TrainTerminals& terminals_;
  const TrainProgramOptions& options_;
  TrainProgram made_;
};

result::Result<void> check_terminals(const TrainProgramInput& input, const TrainTerminals& terminals) {
  const auto missing = [](const std::string& name) {
    return result::fail("L0501", {}, "there is no terminal for " + name,
                        "each terminal of a train needs an address");
  };
  const std::pair<const char*, const std::string*> named[] = {{"x", &terminals.x},
                                                              {"y", &terminals.y},
                                                              {"heading", &terminals.heading},
                                                              {"speed", &terminals.speed},
                                                              {"lock", &terminals.lock},
                                                              {"trailers", &terminals.trailers},
                                                              {"bumper", &terminals.bumper},
                                                              {"estop_ok", &terminals.estop_ok},
                                                              {"way_free", &terminals.way_free},
                                                              {"set_speed", &terminals.set_speed},
                                                              {"set_lock", &terminals.set_lock},
                                                              {"enable", &terminals.enable}};
  for (const auto& [name, address] : named)
    if (address->empty()) return missing(name);
  if (terminals.hitches.size() < input.train->trailers) return missing("each hitch");
  if (terminals.at.size() != input.places.size()) return missing("each place");
  return {};
}

result::Result<void> check_way(const TrainWay& way) {
  if (way.samples.size() > kMostSamples)
    return result::fail("L0502", {}, fmt::format("a way of {} samples", way.samples.size()),
                        "a shorter task, or a larger sample_m");
  for (const vehicle::PathSample& sample : way.samples) {
    if (std::abs(sample.pose.x_m) <= kFarthest_m && std::abs(sample.pose.y_m) <= kFarthest_m) continue;
    return result::fail("L0502", {}, "the way leads farther than 320 m from the origin",
                        "navigation counts centimetres in 16 bits: move the origin into the middle");
  }
  return {};
}

result::Result<void> check_options(const TrainProgramOptions& options) {
  const TrainDrive& d = options.drive;
  const std::pair<const char*, double> figures[] = {
      {"top_speed_m_s", d.top_speed_m_s},
      {"speed_up_m_s2", d.speed_up_m_s2},
      {"brake_m_s2", d.brake_m_s2},
      {"hard_brake_m_s2", d.hard_brake_m_s2},
      {"lateral_m_s2", d.lateral_m_s2},
      {"lock_rate_rad_s", d.lock_rate_rad_s},
      {"speed_lag_s", d.speed_lag_s},
      {"lock_lag_s", d.lock_lag_s},
      {"sample_m", d.sample_m},
      {"fold_rad", options.fold_rad},
      {"interval_us", static_cast<double>(options.interval_us)}};
  for (const auto& [name, value] : figures)
    if (!(std::isfinite(value) && value > 0.0))
      return result::fail("L0502", {}, fmt::format("{} is {}, not above zero", name, value));
  return {};
}

}  // namespace

TrainWatch train_watch(const Automaton& automaton, const std::string& task) {
  return {automaton, task, vehicle::digest(task)};
}

result::Result<TrainProgram> train_program(const TrainProgramInput& input, const TrainTerminals& terminals,
                                           const TrainProgramOptions& options) {
  if (auto good = check_options(options); !good) return result::forward(good);
  if (auto good = check_terminals(input, terminals); !good) return result::forward(good);
  if (input.way != nullptr)
    if (auto good = check_way(*input.way); !good) return result::forward(good);
  return ProjectWriter(input, terminals, options).write();
}

}  // namespace stepwright::ltl

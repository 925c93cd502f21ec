#include "tests/unit/supervisor/ltl/mission/train_hall.h"

#include "plant_models/assemblies/tugger.h"
#include "runtime/ground/result/value_or_throw.h"
#include "tests/unit/supervisor/ltl/program/small_hall.h"

namespace stepwright::ltl::testing {
namespace {

assemblies::FloorPolygon polygon(const Area& area) {
  assemblies::FloorPolygon made{area.name, {}};
  for (const geometry::Point p : area.ring) made.ring.push_back({p.x_m, p.y_m});
  return made;
}

std::unique_ptr<core::Plant> plant_of(const Problem& problem) {
  assemblies::TuggerParameters parameters;
  parameters.trailers = problem.train.trailers;
  parameters.start = {{problem.start.x_m, problem.start.y_m}, problem.start.heading_rad};
  parameters.walls = {polygon(problem.floor.border)};
  for (const Area& each : problem.floor.obstacles) parameters.obstacles.push_back(polygon(each));
  for (const Area& each : problem.floor.propositions) parameters.places.push_back(polygon(each));
  parameters.blockages = {{"crate", {{14.0, 13.0}, {16.0, 13.0}, {16.0, 15.0}, {14.0, 15.0}}},
                          {"pallet", {{14.0, 3.0}, {15.0, 3.0}, {15.0, 5.0}, {14.0, 5.0}}}};
  return result::value_or_throw(assemblies::Tugger::create(parameters));
}

TrainPlanning open(const Problem& problem) {
  return result::value_or_throw(TrainPlanning::open(
      {.problem = problem,
       .terminals = train_terminals_in_a_row(problem.train.trailers, problem.floor.propositions.size()),
       .program = {},
       .most_s = 600.0}));
}

}  // namespace

TrainHall::TrainHall(const std::string& task, std::size_t trailers, std::vector<support::PlantFault> faults)
    : problem_(small_hall(trailers, task)),
      planning_(open(problem_)),
      controller_(plant_of(problem_), bridge::default_tugger_wires(trailers, problem_.places()), {64, 64},
                  std::move(faults)) {}

run::RunRecord TrainHall::run(TrainMissionOptions options, TrainMission::Observer observer) {
  return TrainMission(*planning_, controller_, std::move(options), std::move(observer)).run();
}

std::string story(const run::RunRecord& record) {
  std::string text = std::string(run::to_string(record.phase)) + ": " + record.message;
  for (const run::Incident& incident : record.incidents)
    text += "\n  " + std::to_string(incident.time_s) + " s, " + run::to_string(incident.kind) + ": " +
            run::sentence_of(incident.evidence) + " -> " + run::to_string(incident.response);
  return text;
}

}  // namespace stepwright::ltl::testing

// What people ask for, and what becomes of it.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/ltl/mission/train_mission.h"

namespace stepwright::ltl {

using run::IncidentKind;

namespace {

constexpr const char* kExample = R"_(for example {"request": "goal", "goal": "visit press then rack"})_";
constexpr const char* kExampleOfABlock =
    R"_(for example {"request": "block", "name": "press"}, or with "corners_m": [[1, 1], [3, 1], [3, 2]])_";
constexpr std::size_t kMostCorners = 64;

tl::unexpected<result::Diagnostics> no_block(std::string message, const char* hint) {
  return result::fail("X0005", {}, std::move(message), hint);
}

// A place by its name is out of service, or an area by its corners.
result::Result<TrainChange> block_of(const run::Request& request, const Floor& floor) {
  const auto name = request.text("name");
  if (!name || name->empty()) return no_block("what is blocked has no name", kExampleOfABlock);
  const auto place = std::ranges::find(floor.propositions, *name, &Area::name);
  const bool known = place != floor.propositions.end();
  if (!request.has("corners_m")) {
    if (known) return BlockChange{*place};
    return no_block("the floor has no place '" + *name + "', and corners_m of an area are missing",
                    kExampleOfABlock);
  }
  if (known)
    return no_block("'" + *name + "' is a place of the floor, which is blocked as a whole",
                    "leave corners_m out, or give the area a name of its own");
  const auto corners = request.rows("corners_m", 2, kMostCorners);
  if (!corners || corners->size() < 3)
    return no_block("corners_m are not 3 to 64 pairs of numbers", kExampleOfABlock);
  Area area{.name = *name, .ring = {}, .where = {}};
  for (const std::vector<double>& corner : *corners) area.ring.push_back({corner[0], corner[1]});
  if (auto good = check_outline(area); !good) return result::forward(good);
  return BlockChange{std::move(area)};
}

result::Result<TrainChange> change_of(const run::Request& request, const Floor& floor) {
  const std::string& word = request.word();
  if (word == "hold") return HoldChange{};
  if (word == "resume") return ResumeChange{};
  if (word == "block") return block_of(request, floor);
  const auto text = request.text(word == "goal" ? "goal" : "name");
  if (!text) {
    auto none = run::no_request(kExample);
    return result::forward(none);
  }
  if (word == "goal") return GoalChange{*text};
  return UnblockChange{*text};
}

}  // namespace

std::string TrainMission::goal_form() const {
  const std::vector<std::string> places = planning_.options().problem.places();
  std::string text = "the task of a train is a formula over the places of its floor";
  if (!places.empty()) text += ", for example: visit " + places.front();
  if (places.size() > 1) text += " then visit " + places[1];
  return run::no_goal_form_json(text);
}

result::Result<void> TrainMission::take(const run::Request& request) {
  const std::string& word = request.word();
  if (word == "start") return request_start(request);
  if (word != "hold" && word != "resume" && word != "block" && word != "unblock" && word != "goal")
    return run::not_of_this_mission("start, goal, block, unblock, hold, resume, abort");
  auto change = change_of(request, planning_.options().problem.floor);
  if (!change) return result::forward(change);
  return over() ? run_is_over() : this->request(*change);
}

// With another task, if one comes with it.
result::Result<void> TrainMission::request_start(const run::Request& request) {
  const auto task = request.text_or("goal", "");
  if (!task) return run::no_request(kExample);
  if (!task->empty())
    if (auto good = planning_.task(*task); !good) return result::forward(good);
  return accept_start([&] {
    if (!task->empty()) requests_.add({0.0, GoalChange{*task}});
  });
}

result::Result<void> TrainMission::request(const TrainChange& change) {
  if (const auto* goal = std::get_if<GoalChange>(&change))
    if (auto good = planning_.task(goal->task); !good) return result::forward(good);
  const bool moves =
      std::holds_alternative<HoldChange>(change) || std::holds_alternative<ResumeChange>(change);
  return accept(moves, [&] { requests_.add({0.0, change}); });
}

std::optional<run::Cause> TrainMission::due(double time_s) {
  run::Cause cause{IncidentKind::NewGoal, {}};
  bool replans = false;
  for (const TimedTrainRequest& each : requests_.take(time_s))
    replans |= std::visit([&](const auto& change) { return apply(change, cause); }, each.change);
  if (!cause.evidence.empty()) draw();
  return decide_request(cause, replans);
}

bool TrainMission::apply(const GoalChange& goal, run::Cause& cause) {
  auto task = planning_.task(goal.task);
  if (!task) {
    cause.evidence.push_back("refused: " + result::to_string(task.error()));
    return false;
  }
  take_task(*std::move(task));
  cause.evidence.push_back("another task: " + task_.text);
  return true;
}

bool TrainMission::apply(const BlockChange& block, run::Cause& cause) {
  std::erase_if(blocked_, [&](const Area& area) { return area.name == block.area.name; });
  blocked_.push_back(block.area);
  cause.evidence.push_back(fmt::format("'{}' is blocked", block.area.name));
  return true;
}

bool TrainMission::apply(const UnblockChange& unblock, run::Cause& cause) {
  const std::size_t freed =
      std::erase_if(blocked_, [&](const Area& area) { return area.name == unblock.name; });
  cause.evidence.push_back(freed > 0 ? fmt::format("'{}' is free again", unblock.name)
                                     : fmt::format("'{}' was not blocked", unblock.name));
  return false;  // the plan that is driven is as good as before
}

bool TrainMission::apply(const HoldChange&, run::Cause& cause) {
  return hold_.want(cause);
}

bool TrainMission::apply(const ResumeChange&, run::Cause& cause) {
  return hold_.resume(cause, reading_.estop_ok);
}

}  // namespace stepwright::ltl

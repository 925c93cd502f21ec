#include "supervisor/fleet/mission/problem_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "supervisor/fleet/mission/internal/stand_check.h"
#include "supervisor/fleet/mission/internal/vehicle_reader.h"
#include "supervisor/fleet/network/constraint.h"
#include "supervisor/fleet/schedule/json_place.h"
#include "supervisor/map/map_file.h"

namespace stepwright::fleet {

namespace {

using internal::JsonComplaints;
using internal::JsonItem;
using internal::Names;
using std::chrono::milliseconds;

constexpr std::int64_t kMostLoad = 1'000'000;
constexpr std::size_t kMostNested = 100;

class ProblemReader {
 public:
  ProblemReader(const nlohmann::json& root, const std::filesystem::path& file, JsonComplaints& complaints)
      : root_(root, "", complaints), file_(file), complaints_(complaints) {}

  MissionProblem read() {
    if (!root_.object({"map", "models", "vehicles", "locations", "goals", "tasks", "constraints"})) {
      return std::move(problem_);
    }
    read_map_file();
    internal::read_vehicles(root_, problem_, vehicles_, complaints_);
    read_locations();
    read_goals();
    read_tasks();
    read_routes();
    read_constraints();
    // What follows counts on indices that are right.
    if (complaints_.found.empty()) check_carriers();
    if (complaints_.found.empty()) internal::check_stands(problem_, complaints_);
    return std::move(problem_);
  }

 private:
  void read_map_file() {
    const auto name = root_.text("map");
    if (!name) return;
    auto map = read_map(file_.parent_path() / *name);
    if (!map) {
      for (auto& wrong : map.error()) complaints_.found.push_back(std::move(wrong));
      return;
    }
    problem_.map = *std::move(map);
    const double cells = internal::kLattice_m / problem_.map.frame().resolution_m;
    if (std::abs(cells - std::round(cells)) < 1e-6 && cells > 0.5 && cells < 8.5) return;
    complaints_.add("F0301", "map",
                    fmt::format("its cells of {} m do not divide the 0.2 m between poses",
                                problem_.map.frame().resolution_m),
                    "0.2 m, or a half to an eighth of it");
  }

  milliseconds time(const JsonItem& item, const char* name) {
    return milliseconds(item.whole(name, 0, kHorizon_ms, false).value_or(0));
  }

  void read_locations() {
    for (const JsonItem& item : root_.items("locations")) {
      MissionLocation location{.name = {}, .pose = {}, .key = item.key()};
      if (item.object({"name", "pose", "service_ms"})) {
        location.name = item.text("name").value_or("");
        if (const auto pose = item.member("pose")) location.pose = internal::read_pose(*pose);
        location.service = time(item, "service_ms");
      }
      problem_.locations.push_back(location);
      if (!location.name.empty()) locations_.add(item, location.name, problem_.locations.size() - 1);
    }
  }

  // `name` or, where there is none, one made of the rest.
  std::string name_of(const JsonItem& item, const std::string& otherwise) {
    return item.has("name") ? item.text("name").value_or("") : otherwise;
  }

  void read_goals() {
    const auto items = root_.items("goals");
    for (const JsonItem& item : items) {
      MissionGoal goal;
      goal.key = item.key();
      if (item.object({"name", "amount", "from", "to", "divisible", "vehicle", "after", "due_ms",
                       "earliest_ms", "deadline_ms"})) {
        read_goal(item, goal);
      }
      problem_.goals.push_back(goal);
      if (!goal.name.empty()) goals_.add(item, goal.name, problem_.goals.size() - 1);
    }
    for (std::size_t k = 0; k < items.size(); ++k) {
      for (const JsonItem& before :
           items[k].value().is_object() ? items[k].items("after") : std::vector<JsonItem>()) {
        const auto found = goals_.find(before);
        if (found && *found == k) before.refuse("F0706", "a goal does not come after itself");
        if (found) problem_.goals[k].after.push_back(*found);
      }
      if (items[k].value().is_object()) read_limits(items[k], k);
    }
  }

  void read_goal(const JsonItem& item, MissionGoal& goal) {
    goal.name = item.text("name").value_or("");
    goal.amount = static_cast<std::uint32_t>(item.whole("amount", 1, kMostLoad, false).value_or(1));
    const auto from = locations_.find_member(item, "from");
    const auto to = locations_.find_member(item, "to");
    if (from && to && *from == *to) item.refuse("F0706", "begins and ends at the same location");
    goal.from = from.value_or(0);
    goal.to = to.value_or(0);
    goal.divisible = item.truth("divisible").value_or(true);
    goal.vehicle = vehicles_.find_member(item, "vehicle", false);
    if (item.has("due_ms")) goal.due = time(item, "due_ms");
  }

  void read_limits(const JsonItem& item, std::size_t goal) {
    const std::string& name = problem_.goals[goal].name;
    const auto add = [&](const char* key, Moment moment, Bounds distance, const std::string& words) {
      problem_.constraints.push_back({.name = words + name,
                                      .from = {},
                                      .to = {moment, goal},
                                      .distance = distance,
                                      .key = item.key_of(key)});
    };
    const milliseconds horizon(kHorizon_ms);
    if (item.has("earliest_ms")) {
      add("earliest_ms", Moment::GoalStart, {time(item, "earliest_ms"), horizon}, "earliest start of ");
    }
    if (item.has("deadline_ms")) {
      add("deadline_ms", Moment::GoalEnd, {milliseconds(0), time(item, "deadline_ms")}, "deadline of ");
    }
  }

  void read_tasks() {
    for (const JsonItem& item : root_.items("tasks")) {
      MissionTask task;
      task.key = item.key();
      if (item.object({"name", "vehicle", "to"})) {
        task.vehicle = vehicles_.find_member(item, "vehicle").value_or(0);
        task.location = read_target(item);
        task.name = name_of(item, fmt::format("task {}", problem_.tasks.size() + 1));
        check_free(item, task.vehicle);
      }
      problem_.tasks.push_back(task);
      if (!task.name.empty()) tasks_.add(item, task.name, problem_.tasks.size() - 1);
    }
  }

  // A location's name, or a pose.
  std::size_t read_target(const JsonItem& item) {
    const auto to = item.member("to");
    if (!to) return 0;
    if (!to->value().is_object()) return locations_.find(*to).value_or(0);
    const geometry::Pose pose = internal::read_pose(*to);
    problem_.locations.push_back(
        {.name = fmt::format("({:.1f} m, {:.1f} m)", pose.x_m, pose.y_m), .pose = pose, .key = to->key()});
    return problem_.locations.size() - 1;
  }

  // Who drives a given path or envelope takes no orders.
  void check_free(const JsonItem& item, std::size_t vehicle) {
    if (vehicle >= problem_.vehicles.size()) return;
    const MissionVehicle& named = problem_.vehicles[vehicle];
    if (!named.path && !named.envelope) return;
    (item.has("vehicle") ? *item.maybe("vehicle") : item)
        .refuse("F0706", fmt::format("'{}' drives the {} that is given for it, and nothing else", named.name,
                                     named.path ? "path" : "envelope"));
  }

  void read_routes() {
    const auto items = root_.items("vehicles");
    for (std::size_t v = 0; v < items.size() && v < problem_.vehicles.size(); ++v) {
      if (!items[v].has("route")) continue;
      check_free(items[v], v);
      for (const JsonItem& item : items[v].items("route")) {
        if (!item.object({"pick_up", "set_down", "amount"})) continue;
        if (item.has("pick_up") == item.has("set_down")) {
          item.refuse("F0702", "is neither a pick_up nor a set_down, or both");
          continue;
        }
        HandStop stop{.pick_up = item.has("pick_up")};
        const auto goal = goals_.find_member(item, stop.pick_up ? "pick_up" : "set_down");
        if (!goal) continue;
        stop.goal = *goal;
        stop.amount = static_cast<std::uint32_t>(
            item.whole("amount", 1, kMostLoad, false).value_or(problem_.goals[*goal].amount));
        problem_.vehicles[v].route.push_back(stop);
      }
      check_route(items[v], problem_.vehicles[v]);
    }
  }

  // Nothing is set down that is not aboard, and nothing stays aboard.
  void check_route(const JsonItem& item, const MissionVehicle& vehicle) {
    std::vector<std::pair<std::size_t, std::uint32_t>> aboard;
    std::uint64_t load = 0;
    for (const HandStop& stop : vehicle.route) {
      const std::pair what{stop.goal, stop.amount};
      const std::string& name = problem_.goals[stop.goal].name;
      if (stop.pick_up) {
        aboard.push_back(what);
        load += stop.amount;
        if (load > vehicle.capacity) {
          return refuse_route(item, fmt::format("{} loads are more than the {} that '{}' carries", load,
                                                vehicle.capacity, vehicle.name));
        }
        continue;
      }
      const auto found = std::ranges::find(aboard, what);
      if (found == aboard.end()) {
        return refuse_route(
            item, fmt::format("{} of '{}' are set down before they are picked up", stop.amount, name));
      }
      aboard.erase(found);
      load -= stop.amount;
    }
    if (aboard.empty()) return;
    refuse_route(item,
                 fmt::format("'{}' stays aboard at its end", problem_.goals[aboard.front().first].name));
  }

  void refuse_route(const JsonItem& item, std::string what) {
    complaints_.add("F0706", item.key_of("route"), std::move(what));
  }

  MomentRef read_moment(const JsonItem& item) {
    if (!item.object({"vehicle", "goal", "task", "at"})) return {};
    if (int(item.has("vehicle")) + int(item.has("goal")) + int(item.has("task")) != 1) {
      item.refuse("F0702", "names not exactly one of vehicle, goal and task");
      return {};
    }
    const std::string at = item.text("at").value_or("");
    const bool start = at == "start";
    const bool end = at == "end";
    const bool arrival = at == "arrival" && item.has("vehicle");
    if (!at.empty() && !start && !end && !arrival) {
      item.maybe("at")->refuse("F0702", item.has("vehicle") ? "is none of 'start', 'end' and 'arrival'"
                                                            : "is neither 'start' nor 'end'");
    }
    if (item.has("goal")) {
      return {start ? Moment::GoalStart : Moment::GoalEnd, goals_.find_member(item, "goal").value_or(0)};
    }
    if (item.has("task")) {
      return {start ? Moment::TaskStart : Moment::TaskEnd, tasks_.find_member(item, "task").value_or(0)};
    }
    const Moment moment = arrival ? Moment::VehicleArrival
                          : start ? Moment::VehicleStart
                                  : Moment::VehicleEnd;
    return {moment, vehicles_.find_member(item, "vehicle").value_or(0)};
  }

  void read_constraints() {
    Names names("constraint");
    for (const JsonItem& item : root_.items("constraints")) {
      MissionConstraint constraint;
      constraint.key = item.key();
      if (!item.object({"name", "from", "to", "distance_ms"})) continue;
      constraint.name = item.text("name").value_or("");
      if (!constraint.name.empty()) names.add(item, constraint.name, 0);
      if (const auto from = item.maybe("from")) constraint.from = read_moment(*from);
      if (const auto to = item.member("to")) constraint.to = read_moment(*to);
      constraint.distance = read_distance(item);
      problem_.constraints.push_back(std::move(constraint));
    }
  }

  Bounds read_distance(const JsonItem& item) {
    Bounds bounds{milliseconds(0), milliseconds(kHorizon_ms)};
    const auto pair = item.member("distance_ms");
    if (!pair) return bounds;
    const auto parts = pair->as_items();
    if (parts.size() != 2) {
      pair->refuse("F0702", "is no pair [least, most]");
      return bounds;
    }
    bounds.least = milliseconds(parts[0].as_whole(-kHorizon_ms, kHorizon_ms).value_or(0));
    if (!parts[1].value().is_null()) {
      bounds.most = milliseconds(parts[1].as_whole(-kHorizon_ms, kHorizon_ms).value_or(kHorizon_ms));
    }
    if (bounds.most < bounds.least) {
      pair->refuse("F0706", "has a most below its least", "write [least, most], or null for no most");
    }
    return bounds;
  }

  // Whether somebody may carry each load.
  void check_carriers() {
    std::uint32_t most = 0;
    for (const MissionVehicle& vehicle : problem_.vehicles) {
      if (!vehicle.path && !vehicle.envelope) most = std::max(most, vehicle.capacity);
    }
    for (const MissionGoal& goal : problem_.goals) {
      if (goal.vehicle) check_fixed(goal);
      const std::uint32_t capacity = goal.vehicle ? problem_.vehicles[*goal.vehicle].capacity : most;
      if (capacity == 0) {
        complaints_.add("F0708", goal.key, fmt::format("no vehicle may carry '{}'", goal.name),
                        "a vehicle carries if its capacity is not 0 and neither path nor envelope is given");
      } else if (!goal.divisible && goal.amount > capacity) {
        complaints_.add(
            "F0708", goal.key,
            fmt::format(
                "'{}' is not divisible, and {} loads are more than {} carries ({})", goal.name, goal.amount,
                goal.vehicle ? "'" + problem_.vehicles[*goal.vehicle].name + "'" : std::string("any vehicle"),
                capacity));
      }
    }
  }

  void check_fixed(const MissionGoal& goal) {
    const MissionVehicle& named = problem_.vehicles[*goal.vehicle];
    if (!named.path && !named.envelope) return;
    complaints_.add("F0706", goal.key + ".vehicle",
                    fmt::format("'{}' drives the {} that is given for it, and nothing else", named.name,
                                named.path ? "path" : "envelope"));
  }

  JsonItem root_;
  std::filesystem::path file_;
  JsonComplaints& complaints_;
  MissionProblem problem_;
  Names vehicles_{"vehicle"};
  Names locations_{"location"};
  Names goals_{"goal"};
  Names tasks_{"task"};
};

// Nothing but strange files nests deeper, and the JSON library would take its time.
bool nests_deeply(std::string_view text) {
  std::size_t depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > kMostNested) return true;
  }
  return false;
}

}  // namespace

result::Location place_of(const MissionProblem& problem, const std::string& key) {
  return problem.text.empty() ? result::Location{problem.file, 0, 0}
                              : place_of_key(problem.text, key, problem.file);
}

result::Result<MissionProblem> read_mission_problem(std::string_view text,
                                                    const std::filesystem::path& file) {
  const std::string name = file.string();
  if (nests_deeply(text)) return result::fail("F0701", {name, 0, 0}, "lists are nested more than 100 deep");
  try {
    const auto root = nlohmann::json::parse(text.begin(), text.end());
    JsonComplaints complaints{.text = text, .file = name, .found = {}};
    if (auto twice = double_member(text, name)) {
      complaints.found.push_back({"F0702",
                                  result::Severity::Error,
                                  std::move(twice->where),
                                  fmt::format("the member '{}' is there twice", twice->name),
                                  {}});
    }
    MissionProblem problem = ProblemReader(root, file, complaints).read();
    if (!complaints.found.empty()) return tl::unexpected(std::move(complaints.found));
    problem.file = name;
    problem.text = text;
    return problem;
  } catch (const nlohmann::json::parse_error& error) {
    return result::fail("F0701", place_of_byte(text, error.byte == 0 ? 0 : error.byte - 1, name),
                        "this is no JSON");
  } catch (const nlohmann::json::exception&) {
    return result::fail("F0701", {name, 0, 0}, "a number is too large for any computer");
  }
}

bool is_scheduling_problem(std::string_view text) {
  const auto root = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (!root.is_object() || root.contains("map") || !root.contains("vehicles")) return false;
  const auto& vehicles = root["vehicles"];
  const auto has_polygons = [](const nlohmann::json& v) { return v.is_object() && v.contains("polygons"); };
  return vehicles.is_array() && std::ranges::any_of(vehicles, has_polygons);
}

}  // namespace stepwright::fleet

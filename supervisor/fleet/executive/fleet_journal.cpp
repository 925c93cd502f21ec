#include "supervisor/fleet/executive/fleet_journal.h"

#include <utility>

#include "supervisor/fleet/executive/fleet_document.h"
#include "supervisor/run/internal/journal_json.h"

namespace stepwright::fleet {
namespace {

using run::internal::json;
using std::chrono::milliseconds;

constexpr run::internal::JournalForm kForm{"fleet's journal", 1};

json pose_json(const geometry::Pose& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

geometry::Pose pose_from(const json& value) {
  return {value.at(0), value.at(1), value.at(2)};
}

json area_json(const geometry::ConvexPolygon& area) {
  json corners = json::array();
  for (const geometry::Point p : area.corners()) corners.push_back({p.x_m, p.y_m});
  return corners;
}

geometry::ConvexPolygon area_from(const json& value) {
  std::vector<geometry::Point> corners;
  for (const json& p : value) corners.push_back({p.at(0), p.at(1)});
  auto area = geometry::ConvexPolygon::hull(corners);
  if (!area) throw json::other_error::create(501, "no area", &value);
  return *std::move(area);
}

json times_json(const std::vector<milliseconds>& times) {
  json all = json::array();
  for (const milliseconds time : times) all.push_back(time.count());
  return all;
}

std::vector<milliseconds> times_from(const json& value) {
  std::vector<milliseconds> times;
  for (const json& time : value) times.emplace_back(time.get<std::int64_t>());
  return times;
}

json ledger_json(const LedgerState& state) {
  json orders = json::array();
  for (const MissionGoal& order : state.orders)
    orders.push_back(
        {{"name", order.name}, {"amount", order.amount}, {"from", order.from}, {"to", order.to}});
  json goals = json::array();
  for (const GoalEntry& goal : state.goals) {
    goals.push_back({{"amount", goal.amount},
                     {"delivered", goal.delivered},
                     {"aboard", goal.aboard},
                     {"given_up", goal.given_up},
                     {"why", goal.why},
                     {"late", goal.late},
                     {"starts", times_json(goal.starts)},
                     {"ends", times_json(goal.ends)},
                     {"vehicle", goal.vehicle ? json(*goal.vehicle) : json(nullptr)}});
  }
  json vehicles = json::array();
  for (const VehicleEntry& vehicle : state.vehicles) {
    json aboard = json::array();
    for (const auto& [goal, units] : vehicle.aboard) aboard.push_back({goal, units});
    vehicles.push_back({{"aboard", std::move(aboard)},
                        {"kept", vehicle.kept},
                        {"tasks_done", vehicle.tasks_done},
                        {"task_times", times_json(vehicle.task_times)},
                        {"lost", vehicle.lost},
                        {"why", vehicle.why}});
  }
  return {{"orders", std::move(orders)},
          {"goals", std::move(goals)},
          {"vehicles", std::move(vehicles)},
          {"tasks_dropped", state.tasks_dropped},
          {"limits_dropped", state.limits_dropped}};
}

LedgerState ledger_from(const json& value) {
  LedgerState state;
  for (const json& order : value.at("orders")) {
    MissionGoal goal;
    goal.name = order.at("name");
    goal.amount = order.at("amount");
    goal.from = order.at("from");
    goal.to = order.at("to");
    goal.key = "order " + goal.name;
    state.orders.push_back(std::move(goal));
  }
  for (const json& each : value.at("goals")) {
    GoalEntry goal{.amount = each.at("amount"),
                   .delivered = each.at("delivered"),
                   .aboard = each.at("aboard"),
                   .given_up = each.at("given_up"),
                   .why = each.at("why"),
                   .late = each.at("late"),
                   .starts = times_from(each.at("starts")),
                   .ends = times_from(each.at("ends"))};
    if (!each.at("vehicle").is_null()) goal.vehicle = each.at("vehicle").get<std::uint32_t>();
    state.goals.push_back(std::move(goal));
  }
  for (const json& each : value.at("vehicles")) {
    VehicleEntry vehicle{.tasks_done = each.at("tasks_done"),
                         .task_times = times_from(each.at("task_times")),
                         .lost = each.at("lost"),
                         .why = each.at("why")};
    for (const json& load : each.at("aboard")) vehicle.aboard[load.at(0)] = load.at(1);
    for (const json& goal : each.value("kept", json::array())) vehicle.kept.insert(goal.get<std::size_t>());
    state.vehicles.push_back(std::move(vehicle));
  }
  state.tasks_dropped = value.at("tasks_dropped").get<std::vector<bool>>();
  state.limits_dropped = value.at("limits_dropped");
  return state;
}

json request_json(const FleetRequest& request) {
  json starts = json::array();
  for (const NewStart& start : request.rest.starts) {
    json way = json::array();
    for (const geometry::PathPose& at : start.lead_in)
      way.push_back(
          {at.pose.x_m, at.pose.y_m, at.pose.heading_rad, at.arc_m, at.travel == geometry::Travel::Reverse});
    starts.push_back({{"start", pose_json(start.start)}, {"lead_in", std::move(way)}, {"able", start.able}});
  }
  json standing = json::array();
  for (const Standing& each : request.standing) {
    standing.push_back(
        {{"vehicle", each.vehicle}, {"pose", pose_json(each.pose)}, {"place", area_json(each.place)}});
  }
  json blocked = json::array();
  for (const geometry::ConvexPolygon& area : request.blocked) blocked.push_back(area_json(area));
  return {{"elapsed_ms", request.rest.elapsed.count()},
          {"starts", std::move(starts)},
          {"keep_limits", request.rest.keep_limits},
          {"standing", std::move(standing)},
          {"blocked", std::move(blocked)},
          {"revision", request.revision}};
}

FleetRequest request_from(const json& value) {
  FleetRequest request;
  request.rest.elapsed = milliseconds(value.at("elapsed_ms").get<std::int64_t>());
  request.rest.keep_limits = value.at("keep_limits");
  for (const json& each : value.at("starts")) {
    NewStart start{.start = pose_from(each.at("start")), .lead_in = {}, .able = each.at("able")};
    for (const json& at : each.at("lead_in")) {
      start.lead_in.push_back({pose_from(at), at.at(3).get<double>(),
                               at.at(4).get<bool>() ? geometry::Travel::Reverse : geometry::Travel::Forward});
    }
    request.rest.starts.push_back(std::move(start));
  }
  for (const json& each : value.at("standing")) {
    request.standing.push_back(
        {each.at("vehicle").get<std::uint32_t>(), pose_from(each.at("pose")), area_from(each.at("place"))});
  }
  for (const json& area : value.at("blocked")) request.blocked.push_back(area_from(area));
  request.revision = value.at("revision");
  return request;
}

const char* own_from(const json& document, FleetJournal& journal) {
  journal.ledger = ledger_from(document.at("ledger"));
  journal.request = request_from(document.at("request"));
  for (const json& place : document.at("blocked"))
    journal.blocked.push_back({place.at("name").get<std::string>(), area_from(place.at("area"))});
  journal.first_epoch_s = document.at("first_epoch_s");
  journal.epoch_s = document.at("epoch_s");
  const std::size_t vehicles = journal.ledger.vehicles.size();
  bool fits = journal.request.rest.starts.size() == vehicles;
  for (const Standing& each : journal.request.standing) fits = fits && each.vehicle < vehicles;
  return fits ? nullptr : "its parts do not belong together";
}

}  // namespace

result::Result<void> write_fleet_journal(const std::filesystem::path& file, const FleetJournal& journal) {
  run::Journal kept = journal;
  kept.record.details.erase(kFleetDetails);
  json blocked = json::array();
  for (const Blocked& place : journal.blocked)
    blocked.push_back({{"name", place.name}, {"area", area_json(place.area)}});
  return run::internal::write_journal(file, kForm, kept,
                                      {{"ledger", ledger_json(journal.ledger)},
                                       {"request", request_json(journal.request)},
                                       {"blocked", std::move(blocked)},
                                       {"first_epoch_s", journal.first_epoch_s},
                                       {"epoch_s", journal.epoch_s}});
}

result::Result<std::optional<FleetJournal>> read_fleet_journal(const std::filesystem::path& file) {
  return run::internal::read_journal<FleetJournal>(file, kForm, own_from);
}

}  // namespace stepwright::fleet

// What people ask of a fleet: at once what can be told of it, the rest at the next decision. Its run begins
// at the starts of its problem and its goals are loads: neither another start from where the vehicles are nor
// a plan beside the one that is driven is to be had.

#include <algorithm>

#include "runtime/service/answer_codes.h"
#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::fleet {
namespace {

constexpr const char* kExample =
    R"_(for example {"request": "order", "name": "order 44", "from": "rack 1", "to": "outbound A"})_";
constexpr std::size_t kMostCorners = 64;
constexpr std::uint64_t kMostLoad = 1'000'000;

std::optional<FleetChange> order_of(const run::Request& request) {
  const auto name = request.text("name");
  const auto from = request.text("from");
  const auto to = request.text("to");
  const auto amount = request.count_or("amount", 1, kMostLoad);
  if (!name || !from || !to || !amount) return std::nullopt;
  return OrderChange{*name, *from, *to, static_cast<std::uint32_t>(*amount)};
}

std::optional<FleetChange> block_of(const run::Request& request) {
  const auto name = request.text("name");
  const auto corners = request.rows("corners_m", 2, kMostCorners);
  if (!name || !corners) return std::nullopt;
  std::vector<geometry::Point> points;
  for (const std::vector<double>& corner : *corners) points.push_back({corner[0], corner[1]});
  auto area = geometry::ConvexPolygon::hull(points);
  if (!area) return std::nullopt;
  return BlockChange{{*name, *std::move(area)}};
}

bool is_change(const std::string& word) {
  return word == "hold" || word == "resume" || word == "order" || word == "block" || word == "unblock" ||
         word == "return";
}

// Requires that the word is one of a change. Nothing: without what has to go with it.
std::optional<FleetChange> change_of(const run::Request& request) {
  const std::string& word = request.word();
  if (word == "hold") return HoldChange{};
  if (word == "resume") return ResumeChange{};
  if (word == "order") return order_of(request);
  if (word == "block") return block_of(request);
  const auto name = request.text(word == "unblock" ? "name" : "vehicle");
  if (!name) return std::nullopt;
  if (word == "unblock") return UnblockChange{*name};
  return ReturnChange{*name};
}

}  // namespace

std::string FleetExecutive::goal_form() const {
  std::vector<std::string> locations;
  for (const auto& each : planning_.problem().locations) locations.push_back(each.name);
  return run::no_goal_form_json("a fleet has orders, no goals: give it a new order", locations);
}

result::Result<void> FleetExecutive::take(const run::Request& request) {
  const std::string& word = request.word();
  if (word == "start") {
    if (over())
      return run::not_of_this_mission(
          "a fleet begins where its problem has it begin: start the supervisor again");
    const auto goal = request.text_or("goal", "");
    if (!goal) return run::no_request(kExample);
    if (!goal->empty()) return run::not_of_this_mission("a fleet has orders, no goals: start it without one");
    return request_start();
  }
  if (word == "what_if" || word == "cancel_what_if")
    return run::not_of_this_mission(
        "a fleet has no what-if on the page: `stepwright fleet` plans without driving");
  if (!is_change(word))
    return run::not_of_this_mission("it has a fleet: order, block, unblock, return, hold, resume, abort");
  const auto change = change_of(request);
  if (!change) return run::no_request(kExample);
  return over() ? run_is_over() : this->request(*change);
}

result::Result<void> FleetExecutive::request_start() {
  return accept_start();
}

result::Result<void> FleetExecutive::request(const FleetChange& change) {
  if (const auto* back = std::get_if<ReturnChange>(&change)) {
    bool known = false;
    for (const MissionVehicle& vehicle : planning_.problem().vehicles)
      known = known || vehicle.name == back->vehicle;
    if (!known) {
      return result::fail("X0003", {}, "there is no vehicle '" + back->vehicle + "'",
                          "vehicles are those of the problem's file");
    }
  }
  if (const auto* order = std::get_if<OrderChange>(&change)) {
    FleetLedger trial(planning_.problem());  // what the file says is enough to see whether it can be meant
    if (auto good = trial.order(order->name, order->from, order->to, std::max(1U, order->amount)); !good)
      return good;
  }
  const bool moves =
      std::holds_alternative<HoldChange>(change) || std::holds_alternative<ResumeChange>(change);
  return accept(moves, [&] { requests_.add({0.0, change}); });
}

}  // namespace stepwright::fleet

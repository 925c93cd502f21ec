// The master control of a made plan at a broker: for mqtt_fleet_test.py.
//
//   vda5050_master PORT VEHICLES SEED SECONDS [CA_FILE]     with it: inside TLS
//   vda5050_master PORT VEHICLES SEED SECONDS cancel=NAME   cancels the order of this vehicle once it has
//                                                           it, and exits with 0 when the vehicle has
//                                                           confirmed that
//
// Prints a line for each thing that happens, at the end one JSON object. Exits with 0 once all have arrived.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "supervisor/fleet/vda5050/link/fleet_link.h"
#include "tests/support/vda5050/made_missions.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  using namespace std::chrono_literals;
  if (argc != 5 && argc != 6) return 2;
  const fleet::FleetPlan plan = support::random_plan(static_cast<std::uint32_t>(std::atoi(argv[2])),
                                                     std::strtoull(argv[3], nullptr, 10));
  std::set<std::string> names;
  for (const auto& mission : plan.missions) names.insert(mission.vehicle);
  mqtt::Options options;
  options.port = static_cast<std::uint16_t>(std::atoi(argv[1]));
  options.client_id = "master";
  const std::string last = argc == 6 ? argv[5] : "";
  const std::string cancelled = last.starts_with("cancel=") ? last.substr(7) : "";
  if (argc == 6 && cancelled.empty()) options.tls = mqtt::Tls{argv[5], {}, {}};
  auto client = mqtt::Client::open(options);
  auto orders = fleet::vda5050::FleetOrders::create(plan, {.plan_name = "test"});
  if (!client) std::printf("%s\n", to_string(client.error()).c_str());
  if (!client || !orders) return 1;
  vda5050_link::FleetLink link(*std::move(orders), names, *client, {.resend = 300ms, .cancel_attempts = 4});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[4]));
  std::size_t wrong = 0, connections = 0;
  bool cancelling = false;
  while (!link.all_arrived() && std::chrono::steady_clock::now() < end) {
    const vda5050_link::LinkNews news = link.turn(50ms);
    if (client->connections() > connections)
      std::printf("connected %zu\n", connections = client->connections());
    for (const auto& each : news.wrong) std::printf("%s\n", to_string(each).c_str());
    for (const std::string& name : news.online) std::printf("online %s\n", name.c_str());
    for (const std::string& name : news.lost) std::printf("lost %s\n", name.c_str());
    wrong += news.wrong.size();
    std::fflush(stdout);
    if (cancelled.empty()) continue;
    if (!cancelling) {
      const bool has_it = link.orders().hold(cancelled) == fleet::vda5050::Hold::Ordered &&
                          link.orders().unacknowledged(cancelled, {}).empty();
      if (!has_it) continue;
      if (!link.cancel(cancelled)) return 1;
      cancelling = true;
    }
    if (link.orders().hold(cancelled) == fleet::vda5050::Hold::Idle) {
      std::printf("cancelled, %zu sent again\n", link.repeated());
      return 0;
    }
  }
  const nlohmann::json report = {{"arrived", link.all_arrived()},
                                 {"published", link.published()},
                                 {"repeated", link.repeated()},
                                 {"connections", connections},
                                 {"wrong", wrong},
                                 {"vehicles", names.size()}};
  std::printf("%s\n", report.dump().c_str());
  return link.all_arrived() ? 0 : 1;
}

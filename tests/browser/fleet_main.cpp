// hmi_fleet_supervisor VEHICLES FOLDER DOMAIN SPEED: plans up to seven vehicles in the mine, writes
// FOLDER/cell.toml for the processes of that cell, says "ready", downloads and starts the program as soon as
// a runtime is there, and publishes how it goes. The clock stands at the first event until a line "drive"
// comes on its input; a line "lost v1 SENTENCE" makes its document say so of a vehicle. It ends with its
// input.

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "ladder/driver/compile.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/dds/runtime_client.h"
#include "tests/browser/fleet_follower.h"
#include "tests/support/fleet_program/planned_fleet.h"
#include "tests/support/patience.h"

using namespace stepwright;
using namespace std::chrono_literals;

namespace {

using support::kPatience;

// A vehicle of which the document says that it is lost.
struct Lost {
  std::mutex mutex;
  std::string vehicle;
  std::string reason;
};

std::string cell_toml(const fleet::FleetPlan& plan, const char* domain, const char* speed) {
  std::string text = fmt::format(
      "[cell]\nname = \"fleet\"\n[clock]\nmode = \"simulated\"\nspeed = {}.0\ninterval_us = 20_000\n"
      "[dds]\ndomain_id = {}\n[image]\ninput_bytes = 256\noutput_bytes = 128\n"
      "[plant]\nkind = \"fleet\"\nmap = \"{}/tests/cells/fleet/mine.yaml\"\n",
      speed, domain, STEPWRIGHT_SOURCE_DIR);
  for (const auto& mission : plan.missions) {
    const geometry::Pose& at = mission.path.front().pose;
    text += fmt::format("[[plant.vehicles]]\nx_m = {:.3f}\ny_m = {:.3f}\nheading_deg = {:.3f}\n", at.x_m,
                        at.y_m, at.heading_rad * 57.29577951308232);
  }
  return text;
}

std::string with_lost(const std::string& document, Lost& lost) {
  const std::lock_guard lock(lost.mutex);
  if (lost.vehicle.empty()) return document;
  auto changed = nlohmann::json::parse(document);
  for (auto& vehicle : changed["fleet"]["vehicles"]) {
    if (vehicle["vehicle"] != lost.vehicle) continue;
    vehicle["state"] = "lost";
    vehicle["reason"] = lost.reason;
  }
  return changed.dump();
}

// Twice a second, as a supervisor does.
void follow(dds::RuntimeClient& client, dds::PlanPublisher& publisher, browser::FleetFollower& follower,
            Lost& lost, const std::atomic<bool>& stop) {
  std::string last;
  while (!stop) {
    std::this_thread::sleep_for(500ms);
    const auto snapshot = client.snapshot();
    if (!snapshot) continue;
    const std::string document = with_lost(follower.document(*snapshot), lost);
    if (document != last) (void)publisher.publish(document);
    last = document;
  }
}

void acknowledge(dds::RuntimeClient& client, const std::atomic<bool>& drive, const std::atomic<bool>& stop) {
  drive.wait(false);
  while (!stop) {
    if (const auto event = client.wait_event(200ms)) (void)client.acknowledge(event->sequence);
  }
}

void release(std::atomic<bool>& flag) {
  flag = true;
  flag.notify_all();
}

void obey(Lost& lost, std::atomic<bool>& drive) {
  for (std::string line; std::getline(std::cin, line);) {
    if (line == "drive") release(drive);
    const auto name = line.find(' ');
    const auto reason = line.find(' ', name + 1);
    if (!line.starts_with("lost ") || reason == std::string::npos) continue;
    const std::lock_guard lock(lost.mutex);
    lost.vehicle = line.substr(name + 1, reason - name - 1);
    lost.reason = line.substr(reason + 1);
  }
}

template <typename T>
T taken(result::Result<T> result) {
  if (result) return std::move(*result);
  std::fputs(result::to_string(result.error()).c_str(), stderr);
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const std::string folder = argv[2];
  const char* const domain = argv[3];
  const fleet::FleetPlan plan = fleet::plan_mine(static_cast<std::size_t>(std::atoi(argv[1])));
  const auto program = taken(fleet::fleet_program(plan, fleet::terminals_in_a_row(plan.missions.size()), {}));
  auto compiled = taken(driver::compile({.texts = {}, .projects = {&program.project}}));
  std::ofstream(folder + "/cell.toml") << cell_toml(plan, domain, argv[4]);
  std::puts("ready");
  std::fflush(stdout);

  const dds::ParticipantConfig participant{static_cast<std::uint32_t>(std::atoi(domain)), "supervisor",
                                           "fleet"};
  const auto client = taken(dds::RuntimeClient::connect(participant, dds::ClientRole::Supervisor));
  const auto publisher = taken(dds::PlanPublisher::create(participant));
  if (!client->wait_for_runtime(kPatience)) return 1;
  const std::string digest = taken(client->download(compiled.container));
  if (!client->start({.barrier = true})) return 1;
  browser::FleetFollower follower(plan, program, compiled.container, digest);
  Lost lost;
  std::atomic<bool> drive = false, stop = false;
  std::thread following([&] { follow(*client, *publisher, follower, lost, stop); });
  std::thread driving([&] { acknowledge(*client, drive, stop); });
  obey(lost, drive);
  stop = true;
  release(drive);
  following.join();
  driving.join();
  return 0;
}

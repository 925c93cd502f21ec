#include "tests/bench/shared/step_rates.h"

#include <stdlib.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "plant_models/stepped/stepped_plant.h"

namespace stepwright::bench_shared {
namespace {

using Clock = std::chrono::steady_clock;

const std::string kExamples = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/shared_plant/";
constexpr std::chrono::milliseconds kStep{10};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// `prefix` stands before the names of the terminals: "Tank." of the program in ST.
stepped::SteppedDescription tank(const std::string& prefix) {
  stepped::SteppedDescription about{.name = "tank"};
  about.actuators = {{prefix + "valve"}, {prefix + "drain"}};
  about.sensors = {{prefix + "level", core::PortKind::Count, 0.0, 2.0 / 27'648, "m"}, {prefix + "full"}};
  about.values = {{prefix + "volume", "l", ""}};
  about.faults = {{prefix + "leak", "m/s", ""}};
  about.step = kStep;
  return about;
}

// Steps a second; 0 and a word if it does not run.
double measure(const char* what, std::vector<std::string> command, double seconds,
               const std::string& prefix = {}) {
  stepped::StepCommand start;
  start.arguments = std::move(command);
  start.beginning = std::chrono::minutes(5);
  start.patience = std::chrono::minutes(1);
  stepped::SteppedPlant plant(tank(prefix), std::move(start));
  if (auto started = plant.start(); !started) {
    std::fprintf(stderr, "%s: %s\n", what, result::to_string(started.error()).c_str());
    return 0.0;
  }
  plant.set_actuator(core::ActuatorId(0), 1);
  std::uint64_t steps = 0;
  const auto begin = Clock::now();
  while (seconds_since(begin) < seconds) {
    for (int i = 0; i < 100; ++i, ++steps) {
      if (plant.advance(kStep) == core::PlantStatus::Good) continue;
      std::fprintf(stderr, "%s: %s\n", what, plant.trouble().c_str());
      return 0.0;
    }
  }
  const double rate = static_cast<double>(steps) / seconds_since(begin);
  std::printf("%-28s %10.0f steps/s  %8.2f us\n", what, rate, 1e6 / rate);
  return rate;
}

// What the system alone takes for a byte there and a byte back.
double measure_bytes(double seconds) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) return 0.0;
  const pid_t child = fork();
  char byte = 0;
  if (child == 0) {
    close(ends[0]);
    while (read(ends[1], &byte, 1) == 1 && write(ends[1], &byte, 1) == 1) continue;
    _exit(0);
  }
  close(ends[1]);
  std::uint64_t turns = 0;
  const auto begin = Clock::now();
  while (seconds_since(begin) < seconds) {
    for (int i = 0; i < 100; ++i, ++turns) {
      if (write(ends[0], &byte, 1) != 1 || read(ends[0], &byte, 1) != 1) return 0.0;
    }
  }
  const double rate = static_cast<double>(turns) / seconds_since(begin);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  std::printf("%-28s %10.0f turns/s  %8.2f us\n", "two bytes (baseline)", rate, 1e6 / rate);
  return rate;
}

bool runs(const std::string& command) {
  return std::system(command.c_str()) == 0;
}

double measure_fmu(const std::string& name, const std::string& place, double seconds) {
  const std::string fmu = place + "/" + name + ".fmu";
  if (!runs("python3 " + kExamples + "fmu_pack.py " + name + " " + fmu)) return 0.0;
  const std::string program = std::string(STEPWRIGHT_BIN_DIR) + "/stepwright-plant-fmu";
  const double rate = measure(("FMU " + name).c_str(),
                              {program, "plant-fmu", "--folder", place + "/" + name, "--", fmu}, seconds);
  return rate > 0.0 ? 1e6 / rate : 0.0;
}

}  // namespace

StepRates measure_step_rates(double seconds) {
  StepRates rates;
  std::string place = (std::filesystem::temp_directory_path() / "stepwright-bench-XXXXXX").string();
  if (mkdtemp(place.data()) == nullptr) return rates;
  rates.baseline_turns_per_s = measure_bytes(seconds);
  if (runs("cc -O2 -o " + place + "/tank " + kExamples + "tank.c"))
    rates.c_per_s = measure("C", {place + "/tank"}, seconds);
  rates.python_per_s = measure("Python", {"python3", kExamples + "tank.py"}, seconds);
  rates.fmu2_step_us = measure_fmu("tank2", place, seconds);
  rates.fmu3_step_us = measure_fmu("tank3", place, seconds);
  rates.st_per_s = measure("ST",
                           {std::string(STEPWRIGHT_BIN_DIR) + "/stepwright-plant-st", "plant-st", "--",
                            kExamples + "tank_model.st"},
                           seconds, "Tank.");
  std::filesystem::remove_all(place);
  return rates;
}

}  // namespace stepwright::bench_shared

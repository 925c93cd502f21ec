// How many requests a second the Modbus server answers, and how late, beside libmodbus's own select loop: the
// same clients in the same run, one server after the other, again and again; the median of the rounds counts.
// Ours reads the snapshot of a runtime that scans every millisecond; libmodbus reads arrays. Beside them the
// floor, a server that answers a constant, and how punctual that scan is, idle and under load.
//
//   bench_modbus [--rounds N] [--seconds S] [--json FILE]

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/modbus/floor_server.h"
#include "tests/bench/modbus/libmodbus_server.h"
#include "tests/bench/modbus/load.h"
#include "tests/bench/modbus/runtime_server.h"
#include "tests/bench/modbus/server_process.h"

namespace stepwright::bench {
namespace {

constexpr int kMany = 32;
constexpr std::uint16_t kMarkers = 1'024;  // %MW0 in the map of OpenPLC

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Series {
  std::vector<double> rate_1, p50_1, p99_1, rate_32, p50_32, p99_32;
  std::uint64_t wrong = 0;

  void run(LoadProcess& clients, std::uint16_t port, double seconds) {
    const Served one = clients.run({port, 1, seconds, kMarkers, 10});
    const Served many = clients.run({port, kMany, seconds, kMarkers, 10});
    rate_1.push_back(one.requests_per_s);
    p50_1.push_back(one.p50_us);
    p99_1.push_back(one.p99_us);
    rate_32.push_back(many.requests_per_s);
    p50_32.push_back(many.p50_us);
    p99_32.push_back(many.p99_us);
    wrong += one.wrong + many.wrong;
  }
  void report(nlohmann::json& json, const std::string& prefix) const {
    json[prefix + "requests_per_s_1"] = median(rate_1);
    json[prefix + "p50_us_1"] = median(p50_1);
    json[prefix + "p99_us_1"] = median(p99_1);
    json[prefix + "requests_per_s_32"] = median(rate_32);
    json[prefix + "p50_us_32"] = median(p50_32);
    json[prefix + "p99_us_32"] = median(p99_32);
    json[prefix + "wrong_answers"] = wrong;
  }
};

// The scan while nobody asks, and while 32 clients do.
void measure_scan(RuntimeServer& server, LoadProcess& clients, double seconds, nlohmann::json& json) {
  for (const bool loaded : {false, true}) {
    server.restart();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the map is built anew
    if (loaded) {
      clients.run({server.port(), kMany, seconds, kMarkers, 10});
    } else {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
    const host::TaskStatus task = server.task();
    const std::string suffix = loaded ? "_loaded_us" : "_idle_us";
    json["scan_latency_p99" + suffix] = task.latency.p99_us;
    json["scan_latency_max" + suffix] = task.latency.max_us;
    json["scan_jitter_p99" + suffix] = task.jitter.p99_us;
    json[loaded ? "scan_overruns_loaded" : "scan_overruns_idle"] = task.overruns;
  }
}

int run(int rounds, double seconds, const std::string& file) {
  LoadProcess clients;
  const ServerProcess baseline(serve_with_libmodbus);
  const ServerProcess floor(serve_a_constant);
  RuntimeServer server;
  Series ours;
  Series theirs;
  Series least;
  for (int round = 0; round < rounds; ++round) {
    ours.run(clients, server.port(), seconds);
    theirs.run(clients, baseline.port(), seconds);
    least.run(clients, floor.port(), seconds);
  }
  nlohmann::json json;
  ours.report(json, "");
  theirs.report(json, "libmodbus_");
  least.report(json, "floor_");
  json["ratio_1"] = median(ours.rate_1) / median(theirs.rate_1);
  json["ratio_32"] = median(ours.rate_32) / median(theirs.rate_32);
  json["ratio_p99_32"] = median(ours.p99_32) / median(theirs.p99_32);
  json["ratio_p99_32_floor"] = median(least.p99_32) / median(theirs.p99_32);
  measure_scan(server, clients, 2 * seconds, json);
  std::printf("%s\n", json.dump(2).c_str());
  if (!file.empty()) std::ofstream(file) << json.dump(2) << '\n';
  return 0;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  CLI::App app{"Requests a second and their latency beside libmodbus", "bench_modbus"};
  int rounds = 5;
  double seconds = 0.6;
  std::string file;
  app.add_option("--rounds", rounds, "of each server, in turns")->check(CLI::Range(1, 1'000));
  app.add_option("--seconds", seconds, "of each measurement")->check(CLI::Range(0.1, 60.0));
  app.add_option("--json", file, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  return stepwright::bench::run(rounds, seconds, file);
}

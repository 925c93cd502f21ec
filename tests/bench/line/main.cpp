// Cost of the sorting line in a scan of 10 ms beside Box2D alone with the same bodies moving alike, in the
// same process: what belts, drives, pushers and sensors add to the contacts.
//
//   bench_line [--json FILE]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plant_models/assemblies/sorting_line.h"
#include "plant_models/core/counter_random.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/line/plain_box2d.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kScans = 30'000;  // five minutes
constexpr int kRepeats = 5;

// Switches every output now and then: boxes move, wait, are pushed and pile up.
void operate(assemblies::SortingLine& line, int scan) {
  const core::CounterRandom random(11, 5);
  const auto count = static_cast<std::uint32_t>(line.actuators().size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t bits = random.bits(static_cast<std::uint64_t>(scan / 60) * 64 + i);
    line.set_actuator(core::ActuatorId(i), i + 1 == count || bits % 8 < 3);
  }
}

template <typename Run>
double best_us(Run run) {
  double best = 1e300;
  for (int i = 0; i < kRepeats; ++i) {
    const auto start = Clock::now();
    run();
    best = std::min(best, std::chrono::duration<double, std::micro>(Clock::now() - start).count() / kScans);
  }
  return best;
}

class Recorder {
 public:
  explicit Recorder(const assemblies::SortingLine& line, std::size_t boxes) : line_(line) {
    for (std::size_t i = 1; i <= boxes; ++i) {
      const std::string name = "box_" + std::to_string(i);
      for (const char* what : {"_state", "_x", "_y", "_angle"})
        truths_.push_back(*core::find_truth(line, name + what));
    }
    for (const auto& pusher : line.layout().pushers)
      travels_.push_back(*core::find_truth(line, "travel_" + pusher.name));
  }

  RecordedStep now() const {
    RecordedStep step;
    for (std::size_t i = 0; i < truths_.size(); i += 4) {
      step.push_back({.present = value(truths_[i]) == 1.0f,
                      .x = value(truths_[i + 1]),
                      .y = value(truths_[i + 2]),
                      .angle = value(truths_[i + 3])});
    }
    for (std::size_t i = 0; i < travels_.size(); ++i) {
      const auto& place = line_.layout().pushers[i];
      const auto at = place.home + line_.truth(travels_[i]) * place.direction;
      step.push_back({.present = true, .x = static_cast<float>(at.x), .y = static_cast<float>(at.y)});
    }
    return step;
  }

 private:
  float value(core::TruthId id) const { return static_cast<float>(line_.truth(id)); }

  const assemblies::SortingLine& line_;
  std::vector<core::TruthId> truths_;
  std::vector<core::TruthId> travels_;
};

// What every body does in every step: its velocities lead it to where it is in the next one.
std::vector<RecordedStep> record(const assemblies::LineParameters& parameters) {
  auto line = assemblies::SortingLine::create(parameters).value();
  const Recorder recorder(*line, parameters.boxes);
  std::vector<RecordedStep> steps = {recorder.now()};
  for (int scan = 0; scan < kScans; ++scan) {
    operate(*line, scan);
    for (int half = 0; half < 2; ++half) {
      line->advance(5ms);
      RecordedStep next = recorder.now();
      for (std::size_t i = 0; i < next.size(); ++i) {
        RecordedMotion& motion = steps.back()[i];
        if (!motion.present || !next[i].present) continue;
        motion.vx = (next[i].x - motion.x) * 200.0f;
        motion.vy = (next[i].y - motion.y) * 200.0f;
        motion.spin = (next[i].angle - motion.angle) * 200.0f;
      }
      steps.push_back(std::move(next));
    }
  }
  return steps;
}

int run(const char* json_file) {
  nlohmann::json json = nlohmann::json::array();
  std::printf("sorting line, %d scans of 10 ms (two steps each), best of %d runs\n", kScans, kRepeats);
  for (const std::size_t boxes : {std::size_t{1}, std::size_t{5}, std::size_t{9}}) {
    const assemblies::LineParameters parameters{.boxes = boxes, .arrival_s = 0.5};
    const std::vector<RecordedStep> steps = record(parameters);
    const double line_us = best_us([&] {
      auto line = assemblies::SortingLine::create(parameters).value();
      for (int scan = 0; scan < kScans; ++scan) {
        operate(*line, scan);
        line->advance(10ms);
      }
    });
    double contacts = 0.0;
    const double plain_us = best_us([&] {
      PlainBox2d plain(parameters);
      contacts = 0.0;
      for (const RecordedStep& step : steps) {
        plain.step(step);
        contacts += plain.contacts();
      }
    });
    contacts /= static_cast<double>(steps.size());
    std::printf(
        "  %zu boxes  %7.3f us per scan, Box2D alone %7.3f us, ratio %.2f, %.1f contacts, %.0f times real "
        "time\n",
        boxes, line_us, plain_us, line_us / plain_us, contacts, 1e4 / line_us);
    json.push_back({{"boxes", boxes}, {"line_us", line_us}, {"box2d_us", plain_us}, {"contacts", contacts}});
  }
  if (json_file == nullptr) return result::to_int(result::ExitCode::Done);
  std::ofstream file(json_file);
  file << nlohmann::json{{"scans", kScans}, {"lines", json}}.dump(2) << "\n";
  return result::to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  if (argc == 1) return stepwright::bench::run(nullptr);
  if (argc == 3 && std::strcmp(argv[1], "--json") == 0) return stepwright::bench::run(argv[2]);
  std::fprintf(stderr, "usage: bench_line [--json FILE]\n");
  return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
}

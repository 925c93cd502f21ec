#include "tests/browser/scripted_cell.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "hmi_web/server/image_value.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::browser {
namespace {

using bytecode::ElementaryType;
using reader::Variable;

constexpr std::uint32_t kInputBytes = 8;
constexpr std::uint32_t kOutputBytes = 2;
constexpr std::uint32_t kLevels = kInputBytes + kOutputBytes;  // three REAL
constexpr std::uint32_t kSteps = kLevels + 12;                 // one byte each
constexpr double kSwitchHalfWidth = 0.03;

void put_bit(std::vector<std::byte>& image, std::uint32_t byte, int bit, bool on) {
  if (on) image[byte] |= static_cast<std::byte>(1 << bit);
}

template <typename T>
void put(std::vector<std::byte>& image, std::uint32_t at, T value) {
  std::memcpy(image.data() + at, &value, sizeof value);
}

// A sensor with a little noise that repeats.
double noisy(double percent, double time_s, double phase) {
  return percent + 0.35 * std::sin(9.7 * time_s + phase) + 0.2;
}

void add_tag(server::ProgramLayout& layout, std::string name, std::string type, std::string address,
             Variable where) {
  layout.program.tags.push_back({std::move(name), std::move(type), std::move(address)});
  layout.tags.push_back(where);
}

std::shared_ptr<const server::ProgramLayout> layout_of(const protocol::Program& program) {
  auto layout = std::make_shared<server::ProgramLayout>();
  layout->program = program;
  layout->output_offset = kInputBytes;
  for (std::uint32_t i = 0; i < program.steps.size(); ++i) {
    layout->steps.push_back({ElementaryType::Bool, kSteps + i, bytecode::kNoBit});
  }
  layout->transitions.resize(program.transitions.size());
  for (const auto& [name, address] : {std::pair{"fc1", "%IX0.0"},
                                      {"fc2", "%IX0.1"},
                                      {"fc3", "%IX0.2"},
                                      {"B1", "%QX0.0"},
                                      {"B2", "%QX0.1"},
                                      {"drive_left", "%QX0.2"},
                                      {"drive_right", "%QX0.3"},
                                      {"B3", "%QX0.4"},
                                      {"B4", "%QX0.5"}}) {
    add_tag(*layout, name, "BOOL", address, *server::variable_at(address, kInputBytes));
  }
  for (const auto& [name, address] : {std::pair{"S1", "%IW1"}, {"S2", "%IW2"}, {"S3", "%IW3"}}) {
    add_tag(*layout, name, "INT", address, *server::variable_at(address, kInputBytes));
  }
  std::uint32_t at = kLevels;
  for (const char* name : {"S1_filtered", "S2_filtered", "S3_filtered"}) {
    add_tag(*layout, name, "REAL", "", {ElementaryType::Real, at, bytecode::kNoBit});
    at += 4;
  }
  return layout;
}

}  // namespace

ScriptedCell::ScriptedCell(double speed, double start_s)
    : layout_(layout_of(script_.program())),
      speed_(speed),
      start_s_(start_s),
      end_s_(start_s),
      begun_(std::chrono::steady_clock::now()) {}

double ScriptedCell::now_s() {
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun_;
  return std::min(start_s_ + elapsed.count() * speed_, end_s_);
}

void ScriptedCell::run_until(double end_s) {
  const double now = now_s();
  const std::lock_guard lock(mutex_);
  start_s_ = now;
  end_s_ = std::max(now, std::min(end_s, script_.end_s() + 10));
  begun_ = std::chrono::steady_clock::now();
}

server::Observation ScriptedCell::observe() {
  server::Observation seen;
  const double time_s = now_s();
  seen.runtime_alive = alive_;
  seen.supervisor_alive = true;
  seen.layout = layout_;
  seen.snapshot = snapshot(time_s);
  seen.plan = script_.plan_document(time_s);
  host::RuntimeStatus& status = seen.status.emplace();
  status.state = host::RuntimeState::Running;
  status.trace_hash = 0x9e3779b97f4a7c15u ^ seen.snapshot->scan;
  status.scan_p50_us = 3.9;
  status.scan_p99_us = 7.4;
  status.scan_max_us = 61.8;
  status.realtime_factor = speed_;
  return seen;
}

server::ImageSnapshot ScriptedCell::snapshot(double time_s) const {
  const BenchInstant bench = script_.at(time_s);
  server::ImageSnapshot result;
  result.scan = static_cast<std::uint64_t>(time_s * 100) + 1;
  result.time_s = time_s;
  std::vector<std::byte>& image = result.image;
  image.resize(kSteps + bench.steps.size());
  const auto at = [&](double place) { return std::abs(bench.vehicle_position - place) < kSwitchHalfWidth; };
  put_bit(image, 0, 0, at(0));
  put_bit(image, 0, 1, at(-1));
  put_bit(image, 0, 2, at(1));
  const bool outputs[] = {bench.pump_b1, bench.pump_b2, bench.left,
                          bench.right,   bench.pump_b3, bench.pump_b4};
  for (int bit = 0; bit < 6; ++bit) put_bit(image, kInputBytes, bit, outputs[bit]);
  const double truth[] = {bench.level_v1, bench.level_a1, bench.level_a2};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const double measured = noisy(truth[i], time_s, i);
    put(image, 2 + 2 * i, static_cast<std::int16_t>(measured * 30 + 700));
    put(image, kLevels + 4 * i, static_cast<float>(measured * 30 + 700));
  }
  if (overfull_) put(image, kLevels + 8, 3e38F);
  for (std::size_t i = 0; i < bench.steps.size(); ++i)
    image[kSteps + i] = static_cast<std::byte>(bench.steps[i]);
  const double supplier = 95 - (bench.level_v1 + bench.level_a1 + bench.level_a2 - 60) / 3;
  result.plant = {{"position", bench.vehicle_position},
                  {"level_v1_percent", truth[0]},
                  {"level_a1_percent", truth[1]},
                  {"level_a2_percent", truth[2]},
                  {"level_f1_percent", supplier}};
  return result;
}

std::vector<server::PointSources> ScriptedCell::point_sources() {
  using server::PointSourceKind;
  std::vector<server::PointSources> points;
  for (const auto& [tag, truth] : {std::pair{"S1_filtered", "level_v1_percent"},
                                   {"S2_filtered", "level_a1_percent"},
                                   {"S3_filtered", "level_a2_percent"}}) {
    points.push_back({{PointSourceKind::Tag, tag, 1.0 / 30, -700.0 / 30}});
    points.push_back({{PointSourceKind::PlantTruth, truth}});
  }
  points.push_back({{PointSourceKind::PlantTruth, "level_f1_percent"}});
  points.push_back({{PointSourceKind::PlantTruth, "position"}});
  for (const char* address :
       {"%QX0.2", "%QX0.3", "%IX0.0", "%IX0.1", "%IX0.2", "%QX0.0", "%QX0.1", "%QX0.4", "%QX0.5"}) {
    points.push_back({{PointSourceKind::Address, address}});
  }
  return points;
}

}  // namespace stepwright::browser

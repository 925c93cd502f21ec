#include "tests/bench/engines/monitored_plan.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/value_or_throw.h"
#include "runtime/image/process_image.h"
#include "runtime/native/native_engine.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"
#include "supervisor/executive/planning_service.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/run/image_reader.h"
#include "supervisor/translate/progress.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::byte>;

constexpr std::int64_t kIntervalNs = 10'000'000;

executive::PreparedPlan bench_plan(bool monitors) {
  const std::string cell = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/";
  executive::PlanningOptions options;
  options.domain = cell + "domain.pddl";
  options.problem = cell + "problem.pddl";
  options.binding = cell + "binding.toml";
  options.monitors = monitors;
  const auto planning = result::value_or_throw(executive::PlanningService::open(options));
  auto outcome = result::value_or_throw(
      planning.prepare({.start = {.planning = pddl::to_named(planning.task().initial())}}));
  if (outcome.status != executive::PrepareStatus::Ready) throw std::runtime_error(outcome.reason);
  return std::move(outcome.prepared);
}

// One program with its memory, scanned as its task would be.
class Scanned {
 public:
  Scanned(const Bytes& container, EngineKind kind)
      : loaded_(result::value_or_throw(reader::LoadedProgram::load(container, "bench"))),
        memory_(loaded_.program().memory_size()),
        image_(memory_, scan::layout_of(loaded_.program())),
        stack_(loaded_.program().sizes().stack_slots),
        quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()) {
    const bytecode::Program& program = loaded_.program();
    if (kind == EngineKind::Vm) {
      engine_ = std::make_unique<vm::Interpreter>(program, stack_, quick_code_);
    } else {
      engine_ = result::value_or_throw(native::NativeEngine::compile(program));
    }
    const auto calls = program.container().count<bytecode::Section::ProgramCalls>();
    for (std::uint32_t i = 0; i < calls; ++i) {
      const auto call = program.container().record<bytecode::Section::ProgramCalls>(i);
      calls_.push_back({call.function, call.instance, 0, program.frames_of(0)});
    }
    restart();
  }

  void restart() { image_.reset(loaded_.program().container().section(bytecode::Section::InitialData)); }

  // Returns the budget that it took.
  std::uint64_t scan(const Bytes& inputs, std::int64_t now_ns) {
    constexpr std::uint64_t kPlenty = 100'000'000;
    std::memcpy(image_.inputs().data(), inputs.data(), inputs.size());
    std::uint64_t used = 0;
    for (bytecode::Invocation& call : calls_) {
      call.now_ns = now_ns;
      std::uint64_t budget = kPlenty;
      if (engine_->run(call, image_.memory(), budget)) throw std::runtime_error("the program trapped");
      used += kPlenty - budget;
    }
    return used;
  }

  image::ProcessImage& image() { return image_; }

 private:
  reader::LoadedProgram loaded_;
  Bytes memory_;
  image::ProcessImage image_;
  std::vector<std::uint64_t> stack_;
  Bytes quick_code_;
  std::unique_ptr<bytecode::Engine> engine_;
  std::vector<bytecode::Invocation> calls_;
};

// What the plant showed in every scan of an undisturbed run.
std::vector<Bytes> recorded_inputs(const executive::PreparedPlan& plan) {
  assemblies::BenchParameters parameters;
  parameters.uncertainty = assemblies::SensorUncertainty::none();
  support::SimulatedController controller(parameters);
  Scanned layout(plan.container, EngineKind::Vm);
  std::vector<Bytes> inputs;
  controller.on_scan = [&](std::span<const std::byte> image) {
    std::memcpy(layout.image().bytes().data(), image.data(), image.size());
    inputs.emplace_back(layout.image().inputs().begin(), layout.image().inputs().end());
  };
  const auto reader =
      result::value_or_throw(run::ImageReader::create(plan.container, plan.translation.instance, {}));
  (void)result::value_or_throw(controller.download(plan.container));
  if (!controller.start(false)) throw std::runtime_error("the plan does not start");
  while (const auto event = controller.wait_event(std::chrono::milliseconds(0))) {
    (void)controller.acknowledge(event->sequence);
    const auto now = translate::progress(plan.translation, reader.active_steps(event->image));
    if (!now.failed_steps.empty()) throw std::runtime_error("the plan failed");
    if (now.finished) return inputs;
  }
  throw std::runtime_error("the plan did not end");
}

double pass_us(Scanned& program, const std::vector<Bytes>& inputs) {
  program.restart();
  const auto start = Clock::now();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    program.scan(inputs[i], static_cast<std::int64_t>(i) * kIntervalNs);
  const std::chrono::duration<double, std::micro> all = Clock::now() - start;
  return all.count() / static_cast<double>(inputs.size());
}

// Both over the whole run; the budget that each took.
void compare(Scanned& with, Scanned& without, const std::vector<Bytes>& inputs, MonitorFigures& figures) {
  std::uint64_t with_bytes = 0, without_bytes = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    with_bytes += with.scan(inputs[i], static_cast<std::int64_t>(i) * kIntervalNs);
    without_bytes += without.scan(inputs[i], static_cast<std::int64_t>(i) * kIntervalNs);
    if (!std::ranges::equal(with.image().outputs(), without.image().outputs()))
      throw std::runtime_error("monitors change what the plan does, in scan " + std::to_string(i));
  }
  figures.scans = inputs.size();
  figures.with_bytes = static_cast<double>(with_bytes) / static_cast<double>(inputs.size());
  figures.without_bytes = static_cast<double>(without_bytes) / static_cast<double>(inputs.size());
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

MonitorFigures measure_monitors(EngineKind engine, int passes) {
  const executive::PreparedPlan watched = bench_plan(true);
  const std::vector<Bytes> inputs = recorded_inputs(watched);
  Scanned with(watched.container, engine);
  Scanned without(bench_plan(false).container, engine);
  MonitorFigures figures;
  figures.monitors = watched.translation.monitors.size();
  compare(with, without, inputs, figures);
  std::vector<double> with_us, without_us;
  for (int pass = 0; pass < passes; ++pass) {
    with_us.push_back(pass_us(with, inputs));
    without_us.push_back(pass_us(without, inputs));
  }
  if (passes == 0) return figures;
  figures.with_us = median(with_us);
  figures.without_us = median(without_us);
  return figures;
}

}  // namespace stepwright::bench

#include "cell/testing/suite_runner.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <limits>
#include <utility>

#include "cell/testing/value_text.h"
#include "runtime/base/time_text.h"
#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::cell_testing {

namespace {

using bytecode::Section;
using driver::TestEvent;
using driver::TestEventKind;
using driver::TestHeader;

std::string time_text(std::int64_t ns) {
  const base::ShortText text = base::text_of_time(ns);
  return {text.view().begin(), text.view().end()};
}

Failure failure_at(const TestEvent& event, std::string message, std::string hint = {}) {
  Failure failure;
  failure.statement = event.statement;
  failure.diagnostic = {"", result::Severity::Error, event.where, event.statement + ": " + std::move(message),
                        std::move(hint)};
  return failure;
}

}  // namespace

result::Result<std::unique_ptr<SuiteRunner>> SuiteRunner::make(const driver::TestSuite& suite,
                                                               const RunOptions& options) {
  auto loaded = reader::LoadedProgram::load(suite.container, "tests");
  if (!loaded) return result::forward(loaded);
  std::unique_ptr<SuiteRunner> runner(new SuiteRunner(suite, options, std::move(*loaded)));
  auto engine = host::make_engine(options.engine, runner->loaded_.program());
  if (!engine) return result::forward(engine);
  runner->engine_ = std::move(*engine);
  runner->cycle_ = std::make_unique<scan::ScanCycle>(runner->loaded_.program(), *runner->engine_,
                                                     runner->image_, runner->safe_outputs_, runner->io_,
                                                     runner->no_clock_, scan::ScanConfig{});
  return runner;
}

SuiteRunner::SuiteRunner(const driver::TestSuite& suite, const RunOptions& options,
                         reader::LoadedProgram loaded)
    : suite_(suite),
      options_(options),
      loaded_(std::move(loaded)),
      memory_(loaded_.program().memory_size()),
      image_(memory_, scan::layout_of(loaded_.program())),
      safe_outputs_(image_.outputs().size()) {
  const bytecode::ContainerView& view = loaded_.program().container();
  test_task_ = view.count<Section::Tasks>() - 1;
  for (std::uint32_t i = 0; i < test_task_; ++i) {
    const std::int64_t interval_ns = std::int64_t{view.record<Section::Tasks>(i).interval_us} * 1000;
    if (interval_ns > 0 && (fastest_ns_ == 0 || interval_ns < fastest_ns_)) fastest_ns_ = interval_ns;
  }
}

template <typename T>
T SuiteRunner::read(std::uint32_t address) const {
  T value;
  std::memcpy(&value, memory_.data() + address, sizeof(T));
  return value;
}

TestResult SuiteRunner::run(std::size_t index) {
  const auto begin = std::chrono::steady_clock::now();
  const bytecode::ContainerView& view = loaded_.program().container();
  const driver::TestCase& test = suite_.tests[index];
  const auto task = view.record<Section::Tasks>(test_task_);
  const auto call = view.record<Section::ProgramCalls>(task.first_call + static_cast<std::uint32_t>(index));
  TestResult result;
  result.name = test.name;
  result.where = test.where;
  cycle_->start({});
  clock_ = {};
  std::copy(test.initial.begin(), test.initial.end(), memory_.begin() + call.instance);
  result.failure =
      run_to_end(test, {call.function, call.instance, 0, loaded_.program().frames_of(test_task_)}, result);
  result.simulated_ns = clock_.now_ns;
  result.wall_us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::optional<Failure> SuiteRunner::run_to_end(const driver::TestCase& test, bytecode::Invocation invocation,
                                               TestResult& result) {
  std::uint64_t budget = options_.budget;
  const auto code = loaded_.program().container().record<Section::Functions>(invocation.function);
  const std::uint32_t event_at = invocation.instance + TestHeader::kEvent;
  while (true) {
    invocation.now_ns = clock_.now_ns;
    // To go on behind a wait costs nothing, however long the test is.
    budget += code.code_size;
    if (const bytecode::Trap stopped = engine_->run(invocation, memory_, budget)) return trap(stopped, {});
    const auto number = read<std::uint32_t>(event_at);
    if (number == 0) return std::nullopt;
    assert(number <= test.events.size());
    const TestEvent& event = test.events[number - 1];
    if (event.kind == TestEventKind::Assertion) return assertion(event, invocation.instance);
    const auto argument = read<std::int64_t>(invocation.instance + TestHeader::kArgument);
    if (auto failure = wait(event, argument, result)) return failure;
    const std::uint32_t none = 0;
    std::memcpy(memory_.data() + event_at, &none, sizeof(none));
  }
}

std::optional<Failure> SuiteRunner::wait(const TestEvent& event, std::int64_t argument, TestResult& result) {
  constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
  const bool advances = event.kind == TestEventKind::AdvanceTime;
  if (argument < 0)
    return failure_at(event, advances ? time_text(argument) + " is negative: time goes forward only"
                                      : std::to_string(argument) + " scans cannot be run");
  if (advances) {
    if (argument > kEnd - clock_.now_ns)
      return failure_at(event, "the clock ends before " + time_text(argument) + " have passed");
    return scan_until(event, clock_.now_ns + argument, result);
  }
  if (fastest_ns_ == 0)
    return failure_at(event, "no program runs in a task",
                      "add the program or its CONFIGURATION to the sources, or use ADVANCE_TIME");
  if (argument == 0) return std::nullopt;
  // The fastest task is due at the multiples of its interval.
  const std::int64_t next = clock_.scanned ? (clock_.now_ns / fastest_ns_ + 1) * fastest_ns_ : 0;
  if (argument - 1 > (kEnd - next) / fastest_ns_)
    return failure_at(event, "the clock ends before " + std::to_string(argument) + " scans are run");
  return scan_until(event, next + (argument - 1) * fastest_ns_, result);
}

// Scans everything that is due up to and including `target_ns`; then it is that time.
std::optional<Failure> SuiteRunner::scan_until(const TestEvent& event, std::int64_t target_ns,
                                               TestResult& result) {
  const auto too_many = [&](std::uint64_t scans) {
    return failure_at(event,
                      "waiting until " + time_text(target_ns) + " takes " + std::to_string(scans) +
                          " scans or more, a test has at most " + std::to_string(options_.max_scans),
                      "wait for less, or raise the bound with --max-scans");
  };
  if (fastest_ns_ > 0) {
    // Known before the first scan, so that nobody waits for a mistake.
    const std::int64_t due = cycle_->next_time_ns();
    const std::uint64_t scans =
        result.scans + (due <= target_ns ? static_cast<std::uint64_t>((target_ns - due) / fastest_ns_) : 0);
    if (scans > options_.max_scans) return too_many(scans);
    while (cycle_->next_time_ns() <= target_ns) {
      if (result.scans == options_.max_scans) return too_many(result.scans + 1);
      const scan::ScanReport scanned = cycle_->run_scan();
      ++result.scans;
      clock_.now_ns = scanned.time_ns;
      if (scanned.trap) return trap(scanned.trap, " at " + time_text(scanned.time_ns));
    }
  }
  clock_ = {target_ns, true};
  return std::nullopt;
}

Failure SuiteRunner::assertion(const TestEvent& event, std::uint32_t instance) const {
  Failure failure;
  failure.statement = event.statement;
  failure.actual_text = event.actual_text;
  const auto text = [&](const std::optional<driver::TestOperand>& operand) {
    return operand ? value_text(*operand, instance, image_.bytes()) : std::string();
  };
  if (event.relation == "TRUE" || event.relation == "FALSE") {
    failure.expected = event.relation;
    failure.actual = event.relation == "TRUE" ? "FALSE" : "TRUE";
  } else {
    failure.actual = text(event.actual);
    failure.expected = text(event.expected);
    failure.tolerance = text(event.tolerance);
  }
  std::string wanted = failure.expected;
  if (event.relation == "<>") wanted = "another value";
  if (event.relation == "+-") wanted += " +- " + failure.tolerance;
  if (event.relation.front() == '>' || event.relation == "<" || event.relation == "<=")
    wanted = event.relation + " " + wanted;
  std::string message = event.actual_text + " is " + failure.actual + ", expected " + wanted;
  // References have no value to show.
  if (failure.actual.empty())
    message =
        event.actual_text + (event.relation == "<>" ? " leads to the same place" : " leads to another place");
  if (event.has_message) {
    reader::Variable variable;
    variable.type = bytecode::ElementaryType::String;
    variable.address = instance + TestHeader::kMessage;
    failure.message = reader::read_text(variable, image_.bytes());
    message += ": " + failure.message;
  }
  failure.diagnostic = {"", result::Severity::Error, event.where, event.statement + ": " + message, {}};
  return failure;
}

Failure SuiteRunner::trap(const bytecode::Trap& trap, const std::string& where) const {
  Failure failure;
  failure.diagnostic = reader::describe(loaded_.program(), trap);
  failure.diagnostic.message += where;
  if (where.empty() && trap.code == bytecode::TrapCode::Watchdog)
    failure.diagnostic.hint = "the statements of a test are bounded as a scan is: a loop may never end";
  return failure;
}

}  // namespace stepwright::cell_testing

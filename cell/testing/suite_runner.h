#pragma once

// Runs the tests of a suite, each from a fresh image at time zero.
//
// A test runs until it waits; then the tasks that are due up to and including the time it waits for are
// scanned, as `exec` scans them, and the test goes on at that time. A test's own statements have one budget,
// each scan has one of its own (scan::ScanConfig), and the scans of a test are bounded, so that every test
// ends.
//
//   auto runner = SuiteRunner::make(suite, options);
//   for (std::size_t i = 0; i < suite.tests.size(); ++i) report((*runner)->run(i));
//
// Not thread-safe.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cell/testing/test_result.h"
#include "ladder/driver/compile_tests.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/host/engine_choice.h"
#include "runtime/image/no_io.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::cell_testing {

struct RunOptions {
  host::EngineKind engine = host::EngineKind::Auto;
  std::uint64_t max_scans = 1'000'000;  // of one test: what it waits for beyond that fails it
  std::uint64_t budget = 100'000'000;   // of one test's own statements, in bytes of code
};

class SuiteRunner {
 public:
  // `suite` must outlive the runner. Fails if the engine cannot be had.
  [[nodiscard]] static result::Result<std::unique_ptr<SuiteRunner>> make(const driver::TestSuite& suite,
                                                                         const RunOptions& options);
  SuiteRunner(const SuiteRunner&) = delete;
  SuiteRunner& operator=(const SuiteRunner&) = delete;

  TestResult run(std::size_t index);

 private:
  // Where a test stands.
  struct Clock {
    std::int64_t now_ns = 0;
    bool scanned = false;  // everything due up to now has run
  };

  SuiteRunner(const driver::TestSuite& suite, const RunOptions& options, reader::LoadedProgram loaded);
  std::optional<Failure> run_to_end(const driver::TestCase& test, bytecode::Invocation invocation,
                                    TestResult& result);
  std::optional<Failure> wait(const driver::TestEvent& event, std::int64_t argument, TestResult& result);
  std::optional<Failure> scan_until(const driver::TestEvent& event, std::int64_t target_ns,
                                    TestResult& result);
  Failure assertion(const driver::TestEvent& event, std::uint32_t instance) const;
  Failure trap(const bytecode::Trap& trap, const std::string& where) const;
  template <typename T>
  T read(std::uint32_t address) const;

  const driver::TestSuite& suite_;
  RunOptions options_;
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  image::ProcessImage image_;
  std::vector<std::byte> safe_outputs_;
  image::NoIo io_;
  scan::NoClock no_clock_;
  std::unique_ptr<bytecode::Engine> engine_;
  std::unique_ptr<scan::ScanCycle> cycle_;
  std::uint32_t test_task_ = 0;  // index of the last task
  std::int64_t fastest_ns_ = 0;  // interval of the fastest task of the program; 0: none runs
  Clock clock_;
};

}  // namespace stepwright::cell_testing

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iomanip>

#include "cell/testing/report.h"
#include "ladder/source_files/source_files.h"
#include "runtime/base/time_text.h"

namespace stepwright::cell_testing {

namespace {

// From so many tests on, each line says how far the run has come.
constexpr std::size_t kMany = 20;

std::string simulated(const TestResult& test) {
  if (test.simulated_ns == 0 && test.scans == 0) return {};
  const base::ShortText time = base::text_of_time(test.simulated_ns);
  std::string text(time.view().begin(), time.view().end());
  if (test.scans > 0) text += ", " + std::to_string(test.scans) + (test.scans == 1 ? " scan" : " scans");
  return text;
}

// Terminals must not obey what a source says.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
      '?');
  return text;
}

}  // namespace

std::size_t TestReport::failed() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(tests, [](const TestResult& each) { return !each.passed(); }));
}

double TestReport::simulated_s() const {
  double sum = 0;
  for (const TestResult& each : tests) sum += static_cast<double>(each.simulated_ns) * 1e-9;
  return sum;
}

void print_test(std::ostream& out, const TestResult& test, std::size_t number, std::size_t count,
                std::span<const source::NamedText> files) {
  if (count > kMany)
    out << "[" << std::setw(static_cast<int>(std::to_string(count).size())) << number << "/" << count << "] ";
  out << (test.passed() ? "ok    " : "FAIL  ") << printable(test.name);
  const std::string time = simulated(test);
  if (!time.empty()) out << "  (" << time << ")";
  out << "\n";
  if (!test.failure) return;
  result::Diagnostic shown = test.failure->diagnostic;
  shown.message = printable(shown.message);
  out << source::render(shown, files, sources::style_of(STDOUT_FILENO));
}

void print_summary(std::ostream& out, const TestReport& report) {
  const std::size_t count = report.tests.size();
  const std::size_t failed = report.failed();
  char times[80];
  std::snprintf(times, sizeof(times), "%.6g s simulated in %.3g s", report.simulated_s(), report.wall_s);
  out << count << (count == 1 ? " test: " : " tests: ") << count - failed << " ok, " << failed << " failed";
  if (report.left_out > 0) out << ", " << report.left_out << " left out by the filter";
  out << "; " << times << "\n";
}

}  // namespace stepwright::cell_testing

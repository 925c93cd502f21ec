#include "programs/test/test_command.h"

#include <fnmatch.h>

#include <chrono>
#include <iostream>
#include <utility>

#include "cell/testing/report.h"
#include "ladder/source_files/source_files.h"
#include "runtime/ground/files/files.h"

namespace stepwright::test_program {

namespace {

using result::ExitCode;

// A test of a suite that is to run.
struct Chosen {
  std::size_t suite = 0;
  std::size_t test = 0;
};

bool matches(const std::string& name, const std::string& filter) {
  return filter.empty() || fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

result::Diagnostics nothing(std::string message, std::string hint) {
  return {{"", result::Severity::Error, {}, std::move(message), std::move(hint)}};
}

std::vector<Chosen> choose(const std::vector<driver::TestSuite>& suites, const std::string& filter) {
  std::vector<Chosen> chosen;
  for (std::size_t s = 0; s < suites.size(); ++s)
    for (std::size_t t = 0; t < suites[s].tests.size(); ++t)
      if (matches(suites[s].tests[t].name, filter)) chosen.push_back({s, t});
  return chosen;
}

result::Diagnostics run_chosen(const std::vector<driver::TestSuite>& suites,
                               const std::vector<Chosen>& chosen, const cell_testing::RunOptions& options,
                               const sources::SourceFiles& files, cell_testing::TestReport& report) {
  std::unique_ptr<cell_testing::SuiteRunner> runner;
  std::size_t suite = suites.size();  // of the runner
  for (const Chosen& each : chosen) {
    if (each.suite != suite) {
      auto made = cell_testing::SuiteRunner::make(suites[each.suite], options);
      if (!made) return made.error();
      runner = std::move(*made);
      suite = each.suite;
    }
    report.tests.push_back(runner->run(each.test));
    cell_testing::print_test(std::cout, report.tests.back(), report.tests.size(), chosen.size(), files.files);
    // A failure is seen at once, whatever takes long behind it.
    if (!report.tests.back().passed()) std::cout.flush();
  }
  return {};
}

// Compiles and runs; what kept it from that is returned.
result::Diagnostics run_all(const TestArguments& arguments, sources::SourceFiles& files,
                            cell_testing::TestReport& report) {
  result::Diagnostics problems;
  files = sources::load(arguments.sources, problems, arguments.source_options);
  if (!problems.empty()) return problems;
  auto output = driver::compile_tests(files.input());
  if (!output) return output.error();
  report.diagnostics = std::move(output->warnings);
  std::size_t count = 0;
  for (const driver::TestSuite& each : output->suites) count += each.tests.size();
  if (count == 0)
    return nothing("there is no TEST in the sources",
                   "write TEST 'name' ... END_TEST, or name the file that holds them");
  const std::vector<Chosen> chosen = choose(output->suites, arguments.filter);
  report.left_out = count - chosen.size();
  if (chosen.empty())
    return nothing("no test has a name like '" + arguments.filter + "'",
                   "* stands for any characters: --filter '*pump*'");
  return run_chosen(output->suites, chosen, arguments.options, files, report);
}

}  // namespace

ExitCode run_tests(const TestArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  cell_testing::TestReport report;
  report.engine = arguments.engine;
  sources::SourceFiles files;
  result::Diagnostics problems = run_all(arguments, files, report);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.diagnostics.insert(report.diagnostics.end(), problems.begin(), problems.end());
  if (!report.tests.empty()) cell_testing::print_summary(std::cout, report);
  std::cout.flush();
  for (const auto& [path, text] : {std::pair(arguments.json_file, &cell_testing::to_json),
                                   std::pair(arguments.junit_file, &cell_testing::to_junit)}) {
    if (path.empty()) continue;
    const result::Diagnostics failed = files::write_file(path, text(report));
    report.diagnostics.insert(report.diagnostics.end(), failed.begin(), failed.end());
  }
  sources::print(report.diagnostics, files.files);
  return result::has_errors(report.diagnostics) || report.failed() > 0 ? ExitCode::BadInput : ExitCode::Done;
}

}  // namespace stepwright::test_program

#include <nlohmann/json.hpp>

#include "cell/testing/report.h"
#include "runtime/ground/process/diagnostics_json.h"

namespace stepwright::cell_testing {

namespace {

nlohmann::json place(const result::Location& where) {
  return {{"file", where.file}, {"line", where.line}, {"column", where.column}};
}

nlohmann::json failure_json(const Failure& failure) {
  nlohmann::json json = place(failure.diagnostic.where);
  json["text"] = failure.diagnostic.message;
  json["hint"] = failure.diagnostic.hint;
  if (!failure.diagnostic.code.empty()) json["trap"] = failure.diagnostic.code;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) json[key] = value;
  };
  add("statement", failure.statement);
  add("expression", failure.actual_text);
  add("actual", failure.actual);
  add("expected", failure.expected);
  add("tolerance", failure.tolerance);
  add("message", failure.message);
  return json;
}

}  // namespace

std::string to_json(const TestReport& report) {
  nlohmann::json tests = nlohmann::json::array();
  for (const TestResult& each : report.tests) {
    nlohmann::json test = place(each.where);
    test["name"] = each.name;
    test["passed"] = each.passed();
    test["simulated_ns"] = each.simulated_ns;
    test["scans"] = each.scans;
    test["wall_us"] = each.wall_us;
    if (each.failure) test["failure"] = failure_json(*each.failure);
    tests.push_back(std::move(test));
  }
  const nlohmann::json json = {{"engine", report.engine},
                               {"passed", report.tests.size() - report.failed()},
                               {"failed", report.failed()},
                               {"left_out", report.left_out},
                               {"simulated_s", report.simulated_s()},
                               {"wall_s", report.wall_s},
                               {"diagnostics", process::diagnostics_json(report.diagnostics)},
                               {"tests", std::move(tests)}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace stepwright::cell_testing

#include "ladder/driver/compile_tests.h"

#include <utility>

#include "ladder/driver/front_end.h"

namespace stepwright::driver {

namespace {

std::optional<TestOperand> operand_of(const std::optional<semantics::TestOperand>& kept) {
  if (!kept) return std::nullopt;
  TestOperand operand;
  operand.type = kept->type->elementary;
  operand.offset = kept->offset;
  for (const semantics::Enumerator& each : kept->type->enumerators)
    operand.enumerators.emplace(each.value, each.spelling);
  return operand;
}

TestCase case_of(const semantics::Test& test, const source::SourceSet& sources) {
  TestCase made{test.name, sources.location(test.where), test.pou->type->initial, {}};
  for (const semantics::TestEvent& each : test.events) {
    TestEvent& event = made.events.emplace_back();
    event.kind = each.kind;
    event.where = sources.location(each.where);
    event.statement = each.statement;
    event.actual_text = std::string(each.actual_text);
    event.relation = std::string(each.relation);
    event.actual = operand_of(each.actual);
    event.expected = operand_of(each.expected);
    event.tolerance = operand_of(each.tolerance);
    event.has_message = each.has_message;
  }
  return made;
}

}  // namespace

result::Result<TestOutput> compile_tests(const CompileInput& input) {
  FrontEnd front(input);
  source::DiagnosticSink& sink = front.sink();
  std::vector<std::unique_ptr<semantics::Model>> models;
  const auto groups = front.test_groups();
  for (const semantics::TestGroup& each : groups) models.push_back(front.analyze(&each));
  // A file may be wrong and have no test.
  const semantics::TestGroup none;
  if (groups.empty()) front.analyze(&none);
  if (sink.has_errors()) return tl::unexpected(sink.take());
  TestOutput output;
  for (const auto& model : models) {
    if (model->tests.empty()) continue;
    auto container = front.test_container(*model);
    if (!container) return result::forward(container);
    TestSuite& suite = output.suites.emplace_back();
    suite.container = std::move(*container);
    for (const auto& each : model->tests) suite.tests.push_back(case_of(*each, front.sources()));
  }
  output.warnings = lint::without_suppressed(sink.take(), front.sources());
  return output;
}

}  // namespace stepwright::driver

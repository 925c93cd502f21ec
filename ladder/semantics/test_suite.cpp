#include "ladder/semantics/internal/test_suite.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/statements/statement_analyzer.h"

namespace stepwright::semantics::internal {

namespace {

// An hour: of the tests' task, if it is the only one. Nothing scans then.
constexpr std::uint32_t kNoScanUs = 3'600'000'000;

// The name under which a trap speaks of a test. Containers hold valid UTF-8 only, and short strings.
std::string function_name(const std::string& name, std::size_t number) {
  const bool plain =
      name.size() <= 100 && std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; });
  return "TEST " + (plain ? "'" + name + "'" : std::to_string(number));
}

}  // namespace

void register_tests(Analysis& a, const TestGroup& group) {
  for (const syntax::TestDeclaration* each : group.tests) {
    auto test = std::make_unique<Test>();
    auto pou = std::make_unique<Pou>();
    test->name = each->name;
    test->where = each->body.name.where;
    test->pou = pou.get();
    pou->name = each->body.name.id;
    pou->spelling = function_name(each->name, a.model.tests.size() + 1);
    pou->where = each->body.name.where;
    pou->declaration = &each->body;
    pou->end = each->body.end;
    pou->test = test.get();
    Type* type = a.type_table().create(TypeKind::Instance, pou->spelling);
    type->pou = pou.get();
    pou->type = type;
    a.model.tests.push_back(std::move(test));
    a.model.pous.push_back(std::move(pou));
  }
}

bool has_main(const syntax::Unit& unit, std::size_t user_pous) {
  if (!unit.configurations.empty()) return true;
  const auto end = unit.pous.begin() + static_cast<std::ptrdiff_t>(user_pous);
  return std::count_if(unit.pous.begin(), end,
                       [](const auto& each) { return each.kind == PouKind::Program; }) == 1;
}

void analyze_tests(Analysis& a) {
  for (const auto& each : a.model.tests) StatementAnalyzer(a, *each->pou).body(each->pou->declaration->body);
  auto& tasks = a.model.tasks;
  if (a.model.tests.empty()) return;
  const Position where = a.model.tests.front()->where;
  if (tasks.size() >= bytecode::kMaxTasks)
    a.error(code::kBadTask, where,
            "a program under test has at most " + std::to_string(bytecode::kMaxTasks - 1) + " tasks");
  std::uint32_t size = 1;
  for (const auto& each : a.model.tests) size = std::max(size, each->pou->type->size);
  const auto instance = a.allocate(size, where);
  if (!instance) return;
  Task task;
  task.name = "TEST";
  task.interval_us = tasks.empty() ? kNoScanUs : 0;
  task.trigger = Trigger{"__TEST_IDLE", a.allocate_place(a.type_table().boolean(), where)};
  for (const auto& each : a.model.tests) task.calls.push_back({each->pou->spelling, each->pou, *instance});
  tasks.push_back(std::move(task));
}

}  // namespace stepwright::semantics::internal

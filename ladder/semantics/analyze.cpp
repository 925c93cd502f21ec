#include "ladder/semantics/analyze.h"

#include <utility>

#include "ladder/semantics/internal/declarer.h"
#include "ladder/semantics/internal/statement_analyzer.h"
#include "ladder/semantics/internal/test_suite.h"

namespace stepwright::semantics {

namespace {

using namespace internal;

void register_pous(Analysis& a, const syntax::Unit& unit, const TestGroup* tests) {
  for (const syntax::PouDeclaration& original : unit.pous) {
    const syntax::PouDeclaration& declaration = tests != nullptr ? mock_of(original, *tests) : original;
    auto pou = std::make_unique<Pou>();
    pou->name = declaration.name.id;
    pou->spelling = std::string(declaration.name.text);
    pou->kind = declaration.kind;
    pou->where = declaration.name.where;
    pou->declaration = &declaration;
    pou->end = declaration.end;
    if (declaration.kind != PouKind::Function) {
      Type* type = a.type_table().create(TypeKind::Instance, pou->spelling);
      type->pou = pou.get();
      pou->type = type;
    }
    ElementaryType elementary{};
    const bool taken = elementary_from(a.names.folded(pou->name), elementary) ||
                       !a.pous.try_emplace(pou->name.value, pou.get()).second;
    if (taken && !pou->spelling.empty())
      a.error(code::kDuplicate, pou->where, "there is another POU or type named " + quote(pou->spelling),
              "standard function blocks have their names for themselves");
    a.model.pous.push_back(std::move(pou));
  }
}

enum class Visit : std::uint8_t { Open, Running, Done };

// Calls are a tree: what a POU needs in memory and on the stack is known when it is loaded.
bool reaches_itself(const Pou& pou, std::unordered_map<const Pou*, Visit>& visits) {
  Visit& visit = visits[&pou];
  if (visit == Visit::Done) return false;
  if (visit == Visit::Running) return true;
  visit = Visit::Running;
  bool found = false;
  for (const Pou* each : pou.callees) found = reaches_itself(*each, visits) || found;
  visits[&pou] = Visit::Done;
  return found;
}

void check_recursion(Analysis& a) {
  std::unordered_map<const Pou*, Visit> visits;
  for (const auto& each : a.model.pous) {
    if (reaches_itself(*each, visits))
      a.error(code::kRecursion, each->where,
              quote(each->spelling) + " calls itself, directly or through others",
              "PLC programs do not recurse (6.6.1.9); use a loop");
  }
}

}  // namespace

std::unique_ptr<Model> analyze(const syntax::Unit& unit, std::size_t user_pous, source::NameTable& names,
                               source::DiagnosticSink& sink, const TestGroup* tests) {
  auto model = std::make_unique<Model>();
  Analysis a{*model, names, sink, {}, {}, {}, {}, {}, {}};
  register_pous(a, unit, tests);
  if (tests != nullptr) register_tests(a, *tests);
  TypeResolver types(a, unit);
  // Types may name constants, the other globals may name types.
  declare_globals(a, types, unit, true);
  types.declare_all();
  declare_globals(a, types, unit, false);
  for (const auto& pou : model->pous) types.lay_out(*pou);
  if (tests != nullptr) check_mocks(a, types, unit, *tests);
  note_block_tasks(a, unit);
  for (const auto& pou : model->pous)
    if (pou->test == nullptr) StatementAnalyzer(a, *pou).body(pou->declaration->body);
  check_recursion(a);
  protect_inputs(a);
  if (tests == nullptr || has_main(unit, user_pous)) configure(a, types, unit, user_pous);
  // Tests name the variables of program instances.
  if (tests != nullptr) analyze_tests(a);
  place_hierarchical(a);
  check_overlaps(a);
  return model;
}

}  // namespace stepwright::semantics

#include "ladder/semantics/analyze.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/analysis/hierarchical_address.h"
#include "ladder/semantics/calls/call_analyzer.h"
#include "ladder/semantics/configuration/configure.h"
#include "ladder/semantics/declarations/declarer.h"
#include "ladder/semantics/internal/test_suite.h"
#include "ladder/semantics/internal/watcher.h"
#include "ladder/semantics/statements/statement_analyzer.h"
#include "runtime/bytecode/container_format.h"

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

// Where a walk over the calls is with a POU.
struct Visit {
  bool done = false;
  std::uint32_t depth = 0;  // of the calls that it makes, itself included
};

// Calls are a tree: what a POU needs in memory and on the stack is known when it is loaded.
// Its own stack holds the walk: a source decides how long a chain of calls is.
class CallWalk {
 public:
  // True if a walk from `pou` comes back to a POU that it is in.
  bool reaches_itself(const Pou& pou) {
    bool found = false;
    std::vector<Frame> frames;
    if (visits_.try_emplace(&pou).second) frames.push_back({&pou});
    while (!frames.empty()) {
      Frame& top = frames.back();
      if (top.next == top.pou->callees.size()) {
        visits_[top.pou] = {true, top.below + 1};
        const std::uint32_t depth = top.below + 1;
        frames.pop_back();
        if (!frames.empty()) frames.back().below = std::max(frames.back().below, depth);
        continue;
      }
      const Pou* callee = top.pou->callees[top.next++];
      const auto [visit, is_new] = visits_.try_emplace(callee);
      if (is_new) {
        frames.push_back({callee});
      } else if (visit->second.done) {
        top.below = std::max(top.below, visit->second.depth);
      } else {
        found = true;
      }
    }
    return found;
  }

  std::uint32_t depth_of(const Pou& pou) const { return visits_.at(&pou).depth; }

 private:
  struct Frame {
    const Pou* pou = nullptr;
    std::size_t next = 0;     // callee
    std::uint32_t below = 0;  // depth of the deepest callee so far
  };
  std::unordered_map<const Pou*, Visit> visits_;
};

// False if there is a chain of calls that is too long to be walked.
bool check_calls(Analysis& a) {
  bool sound = true;
  CallWalk walk;
  for (const auto& each : a.model.pous) {
    const bool recurses = walk.reaches_itself(*each);
    sound = sound && walk.depth_of(*each) <= bytecode::kMaxCallDepth;
    // One report where a chain gets too long, not one for each POU above.
    if (!recurses && walk.depth_of(*each) == bytecode::kMaxCallDepth + 1)
      a.error(code::kTooDeep, each->where,
              quote(each->spelling) + " calls others more than " + std::to_string(bytecode::kMaxCallDepth) +
                  " levels deep",
              "let one POU call several in turn instead of each the next");
    if (recurses)
      a.error(code::kRecursion, each->where,
              quote(each->spelling) + " calls itself, directly or through others",
              "PLC programs do not recurse (6.6.1.9); use a loop");
  }
  return sound;
}

}  // namespace

std::unique_ptr<Model> analyze(const syntax::Unit& unit, std::size_t user_pous, source::NameTable& names,
                               source::DiagnosticSink& sink, const AnalysisOptions& options) {
  const TestGroup* tests = options.tests;
  auto model = std::make_unique<Model>();
  Analysis a{*model, names, sink, value_of_call, {}, {}, {}, {}, {}, {}};
  a.dialect = options.dialect;
  for (const syntax::Configuration& configuration : unit.configurations) {
    a.list_names.insert(configuration.name.id.value);
    for (const syntax::Resource& each : configuration.resources) a.list_names.insert(each.name.id.value);
  }
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
  for (std::size_t k = 0; k < options.watchers.size(); ++k) {
    Pou& watcher = *model->pous[options.first_watcher + k];
    watcher.watches = true;
    watcher.outside_reads = options.watchers[k];
  }
  for (const auto& pou : model->pous)
    if (pou->test == nullptr && !pou->watches) StatementAnalyzer(a, *pou).body(pou->declaration->body);
  // What follows walks along the calls.
  if (!check_calls(a)) return model;
  protect_inputs(a);
  const bool runs = has_main(unit, user_pous);
  if (runs || (tests == nullptr && !options.library)) configure(a, types, unit, user_pous);
  // Tests name the variables of program instances.
  if (tests != nullptr) analyze_tests(a);
  if (tests == nullptr && runs && !sink.has_errors())
    for (std::size_t k = 0; k < options.watchers.size(); ++k)
      add_watcher(a, *model->pous[options.first_watcher + k]);
  place_hierarchical(a);
  check_overlaps(a);
  return model;
}

}  // namespace stepwright::semantics

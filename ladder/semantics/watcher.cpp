// Programs that watch others: see internal/watcher.h.

#include "ladder/semantics/internal/watcher.h"

#include <algorithm>

#include "ladder/semantics/statements/statement_analyzer.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

namespace {

// Whether the task runs one of the instances, with its connections or without.
bool runs_watched(const Model& model, const Task& task, const Pou& watcher) {
  return std::ranges::any_of(watcher.watched, [&](std::uint32_t instance) {
    return std::ranges::any_of(task.calls, [&](const TaskCall& call) {
      return naming::same_name(call.name, model.instances[instance].name);
    });
  });
}

}  // namespace

void add_watcher(Analysis& a, Pou& pou) {
  StatementAnalyzer(a, pou).body(pou.declaration->body);
  if (a.sink.has_errors()) return;
  const bool taken = std::ranges::any_of(
      a.model.instances, [&](const auto& each) { return naming::same_name(each.name, pou.spelling); });
  if (taken)
    return a.error(code::kDuplicate, pou.where, "there is another instance named " + quote(pou.spelling));
  Task* chosen = nullptr;
  for (Task& task : a.model.tasks) {
    if (!runs_watched(a.model, task, pou)) continue;
    if (chosen != nullptr) {
      return a.error(code::kBadTask, pou.where,
                     quote(pou.spelling) + " reads programs of the tasks " + quote(chosen->name) + " and " +
                         quote(task.name),
                     "copy what it reads of one of them into global variables");
    }
    chosen = &task;
  }
  if (chosen == nullptr) chosen = &a.model.tasks.front();
  const Place place = a.allocate_place(pou.type, pou.where);
  a.model.instances.push_back({pou.spelling, &pou, place.offset, Retention::Unsaid});
  chosen->calls.push_back({pou.spelling, &pou, place.offset});
}

}  // namespace stepwright::semantics::internal

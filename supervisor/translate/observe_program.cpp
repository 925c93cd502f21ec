#include "supervisor/translate/observe_program.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "supervisor/translate/chart_writer.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::translate {

namespace {

using graphic::Condition;
using graphic::StepId;

// One fact of the group is observed.
Condition located(const OneOf& group, const Binding& binding) {
  std::vector<Condition> places;
  for (const std::string& fact : group.facts) places.push_back(fact_is(*binding.observed(fact), true));
  return graphic::any(std::move(places));
}

class ObserveChart {
 public:
  ObserveChart(const Binding& binding, const ObserveOptions& options)
      : binding_(binding), options_(options), writer_(binding) {}

  Translation build() {
    at_rest_ = add("AT_REST", StepKind::Start, "levels come to rest");
    const StepId average = add("AVERAGE", StepKind::Settle, "mean of every sensor", kAveragingVariable);
    const StepId observed = add("OBSERVED", StepKind::Done, "");
    std::vector<Condition> ready{writer_.after(at_rest_, options_.rest)};
    if (options_.locate) {
      for (const OneOf& group : binding_.one_of) {
        if (!group.searches.empty()) ready.push_back(located(group, binding_));
      }
    }
    writer_.transition({at_rest_}, {average}, graphic::all(std::move(ready)), "at rest");
    writer_.transition({average}, {observed}, writer_.after(average, options_.window), "averaged");
    if (options_.locate) add_searches();
    return finish();
  }

 private:
  StepId add(std::string name, StepKind kind, std::string comment, const std::string& output = {},
             milliseconds timeout = milliseconds{0}) {
    StepInfo info;
    info.name = std::move(name);
    info.kind = kind;
    info.timeout = timeout;
    return writer_.step(std::move(info), std::move(comment),
                        output.empty() ? std::vector<std::string>{} : std::vector<std::string>{output});
  }

  // Each search of a group takes over where the one before it found nothing; what one finds comes to rest
  // first, because a vehicle may run past its switch.
  void add_searches() {
    std::optional<StepId> lost;
    for (std::size_t g = 0; g < binding_.one_of.size(); ++g) {
      const OneOf& group = binding_.one_of[g];
      if (group.searches.empty()) continue;
      if (!lost) lost = add("LOST", StepKind::Failed, "no search found anything");
      const Condition found = located(group, binding_);
      StepId from = at_rest_;
      Condition go = graphic::all({writer_.after(at_rest_, options_.rest), *inverse(found)});
      for (std::size_t s = 0; s < group.searches.size(); ++s) {
        const Search& search = group.searches[s];
        const StepId step = add(search_step(g, s), StepKind::Search, "search", search.output, search.timeout);
        writer_.transition({from}, {step}, std::move(go), "nothing observed");
        writer_.transition({step}, {at_rest_}, found, "found");
        go = graphic::all({writer_.after(step, search.timeout), *inverse(found)});
        from = step;
      }
      writer_.transition({from}, {*lost}, std::move(go), "nothing found");
    }
  }

  Translation finish() {
    SensorProgramOptions sensing;
    sensing.mode = SensorMode::Mean;
    sensing.interval_us = options_.interval_us;
    const auto samples = std::chrono::microseconds(options_.window).count() / options_.interval_us;
    sensing.half_samples = std::max<std::int64_t>(1, samples / 2);
    assert(writer_.problems().empty());  // read_binding keeps these names free
    Translation translation;
    translation.program = kPlanProgram;
    translation.instance = kPlanInstance;
    translation.steps = writer_.take_steps();
    translation.project = make_project(binding_, sensing, writer_.take_chart());
    return translation;
  }

  const Binding& binding_;
  const ObserveOptions& options_;
  ChartWriter writer_;
  StepId at_rest_;
};

}  // namespace

Translation observe_program(const Binding& binding, const ObserveOptions& options) {
  assert(options.rest.count() > 0 && options.window.count() > 0);
  return ObserveChart(binding, options).build();
}

}  // namespace stepwright::translate

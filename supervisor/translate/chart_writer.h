#pragma once

// Builds a chart step by step together with what each step means. Private detail of the programs that this
// folder generates: names stay unique against the binding's variables, transitions are numbered.

#include <string>
#include <vector>

#include "ladder/graphic/identifier.h"
#include "supervisor/translate/translation.h"

namespace stepwright::translate {

class ChartWriter {
 public:
  // Step names must differ from the variables that the programs of `binding` declare.
  explicit ChartWriter(const Binding& binding);

  // `comment` is shown beside the step. The first step is the initial one.
  graphic::StepId step(StepInfo info, std::string comment, const std::vector<std::string>& outputs = {});
  // Of transitions with a common source the one that is added first is tested first.
  void transition(std::vector<graphic::StepId> sources, std::vector<graphic::StepId> targets,
                  graphic::Condition condition, std::string comment);

  // "STEP.T >= T#1500ms"
  graphic::Condition after(graphic::StepId step, milliseconds time) const;

  // Every step whose name is taken (T0006).
  const result::Diagnostics& problems() const { return problems_; }
  graphic::SfcChart take_chart() { return std::move(chart_); }
  std::vector<StepInfo> take_steps() { return std::move(steps_); }

 private:
  std::string file_;
  graphic::NameSet names_;
  graphic::SfcChart chart_;
  std::vector<StepInfo> steps_;
  result::Diagnostics problems_;
};

// "T#90s", "T#250ms"; requires time >= 0.
std::string time_literal(milliseconds time);

}  // namespace stepwright::translate

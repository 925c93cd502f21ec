#pragma once

// A chart that is written step by step. Transitions are numbered and tested in the order in which they come.
//
// A value; one thread at a time. Example:
//   ChartBuilder chart;
//   const StepId start = chart.step("START", "the way begins");
//   chart.action("BEGIN", "permitted := 0.0;\n", Qualifier::P1);    // of that step
//   chart.transition(start, chart.step("DONE", "it stands"), contact("standing"));

#include <string>
#include <utility>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::vehicle {

class ChartBuilder {
 public:
  // The first one is the initial step.
  graphic::StepId step(std::string name, std::string comment);
  // Of the step that was written last: a body of its own, or what it drives.
  void action(const std::string& name, std::string body,
              graphic::Qualifier qualifier = graphic::Qualifier::N);
  void drives(const std::string& target, graphic::Qualifier qualifier = graphic::Qualifier::N);
  void transition(graphic::StepId from, graphic::StepId to, graphic::Condition condition,
                  std::string comment = {});

  graphic::SfcChart take() { return std::move(chart_); }

 private:
  graphic::SfcChart chart_;
};

}  // namespace stepwright::vehicle

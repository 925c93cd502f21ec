#include "supervisor/vehicle/news_chart.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "supervisor/vehicle/literals.h"

namespace stepwright::vehicle {

graphic::SfcChart news_chart(std::chrono::milliseconds every) {
  graphic::SfcChart chart;
  for (const char* name : {"TICK", "TOCK"}) {
    graphic::Step step;
    step.name = name;
    step.initial = chart.steps.empty();
    chart.steps.push_back(std::move(step));
  }
  for (std::uint32_t from = 0; from < 2; ++from) {
    graphic::Transition turn;
    turn.name = fmt::format("T{:03}", from);
    turn.sources = {graphic::StepId(from)};
    turn.targets = {graphic::StepId(1 - from)};
    turn.condition = graphic::compare(chart.steps[from].name + ".T", graphic::CompareOp::GreaterEqual,
                                      time_literal(every));
    turn.priority = 1;
    chart.transitions.push_back(std::move(turn));
  }
  return chart;
}

}  // namespace stepwright::vehicle

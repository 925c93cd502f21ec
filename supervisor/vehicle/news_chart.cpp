#include "supervisor/vehicle/news_chart.h"

#include "supervisor/vehicle/chart_builder.h"
#include "supervisor/vehicle/literals.h"

namespace stepwright::vehicle {

graphic::SfcChart news_chart(std::chrono::milliseconds every) {
  const auto after = [&](const char* step) {
    return graphic::compare(std::string(step) + ".T", graphic::CompareOp::GreaterEqual, time_literal(every));
  };
  ChartBuilder chart;
  const graphic::StepId tick = chart.step("TICK", {});
  const graphic::StepId tock = chart.step("TOCK", {});
  chart.transition(tick, tock, after("TICK"));
  chart.transition(tock, tick, after("TOCK"));
  return chart.take();
}

}  // namespace stepwright::vehicle

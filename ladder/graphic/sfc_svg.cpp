// The SVG of a chart; see sfc_drawing.h.

#include "ladder/graphic/sfc_drawing.h"
#include "ladder/graphic/sfc_painter.h"
#include "ladder/graphic/svg_style.h"

namespace stepwright::graphic {

result::Result<std::string> draw_sfc_svg(const SfcChart& chart) {
  result::Diagnostics diagnostics = check(chart);
  if (result::has_errors(diagnostics)) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  const SfcLayout layout = lay_out(chart, svg_sfc_metrics());
  SvgWriter svg(layout.width, layout.height, "SFC", drawing_style() + sfc_style());
  SfcPainter painter(chart, svg);
  painter.lines(layout.lines);
  for (const PlacedStep& step : layout.steps) painter.step(step, step.jumps);
  for (const PlacedTransition& transition : layout.transitions) painter.transition(transition);
  for (const PlacedJump& jump : layout.jumps) painter.jump(jump, chart.steps[jump.target.value].name);
  return svg.finish();
}

}  // namespace stepwright::graphic

// The SVG of a ladder diagram; see ladder_drawing.h.

#include "ladder/graphic/ladder_drawing.h"
#include "ladder/graphic/ladder_painter.h"
#include "ladder/graphic/svg_style.h"

namespace stepwright::graphic {

std::string draw_ladder_svg(const LadderProgram& program) {
  const LadderMetrics metrics = svg_ladder_metrics();
  const LadderLayout layout = lay_out(program, metrics);
  SvgWriter svg(layout.width, layout.height, "Ladder diagram", drawing_style() + ladder_style());
  LadderPainter painter(program, layout, svg);
  painter.rails(metrics.margin, layout.height - metrics.margin);
  for (const PlacedRung& rung : layout.rungs) painter.rung(rung);
  return svg.finish();
}

}  // namespace stepwright::graphic

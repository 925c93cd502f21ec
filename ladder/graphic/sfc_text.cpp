// The drawing of a chart for terminals; see sfc_drawing.h.

#include "ladder/graphic/sfc_drawing.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/text_canvas.h"

namespace stepwright::graphic {
namespace {

constexpr SfcMetrics metrics{.step_padding = 2, .min_step_width = 7, .action_gap = 3, .condition_width = 36};

int length(const std::string& text) {
  return static_cast<int>(length_of(text));
}

void draw(TextCanvas& canvas, const SfcChart& chart, const PlacedStep& placed) {
  const Step& step = chart.steps[placed.step.value];
  canvas.box(placed.x, placed.y, placed.width, placed.height, step.initial);
  canvas.text(placed.axis - length(step.name) / 2, placed.y + 1, step.name);
  canvas.text(placed.axis - length(step.comment) / 2, placed.y + 2, step.comment);
  for (const PlacedAction& action : placed.actions) {
    const std::string open = action.y == placed.y ? "───" : "  └";
    canvas.text(placed.x + placed.width, action.y + 1, open);
    canvas.text(placed.actions_x, action.y + 1, "[" + qualifier_text(*action.block));
    canvas.text(placed.actions_x + placed.qualifier_width, action.y + 1, action.block->target + "]");
  }
  if (placed.jumps.empty()) return;
  const int y = placed.top + 1;
  canvas.text(placed.axis - 3, y, "──>");
  canvas.text(placed.axis - 4 - length(placed.jumps), y, placed.jumps);
}

void draw(TextCanvas& canvas, const PlacedTransition& placed) {
  canvas.text(placed.axis - metrics.bar, placed.y, "━━╋━━");
  canvas.text(placed.axis - metrics.bar - 1 - length(placed.label), placed.y, placed.label);
  for (std::size_t i = 0; i < placed.text.size(); ++i) {
    canvas.text(placed.axis + metrics.bar + 2, placed.y + static_cast<int>(i), placed.text[i]);
  }
}

}  // namespace

result::Result<std::string> draw_sfc_text(const SfcChart& chart) {
  result::Diagnostics diagnostics = check(chart);
  if (result::has_errors(diagnostics)) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  const SfcLayout layout = lay_out(chart, metrics);
  TextCanvas canvas;
  for (const PlacedLine& line : layout.lines) {
    // In characters a row's end and the next row's start are different lines of text.
    if (line.y1 == line.y2) {
      canvas.horizontal(line.x1, line.x2, line.y1, line.doubled);
    } else {
      canvas.vertical(line.x1, line.y1, line.y2);
    }
  }
  for (const PlacedStep& step : layout.steps) draw(canvas, chart, step);
  for (const PlacedTransition& transition : layout.transitions) draw(canvas, transition);
  for (const PlacedJump& jump : layout.jumps) {
    canvas.text(jump.axis, jump.y, "▼ " + chart.steps[jump.target.value].name);
  }
  return canvas.finish();
}

}  // namespace stepwright::graphic

#include "ladder/graphic/sfc_painter.h"

#include <algorithm>

namespace stepwright::graphic {
namespace {

constexpr SfcMetrics metrics{.margin = 16,
                             .character = 8,
                             .small_character = 7,
                             .line = 16,
                             .step_padding = 12,
                             .step_padding_y = 8,
                             .min_step_width = 64,
                             .action_gap = 16,
                             .action_row = 22,
                             .cell_padding = 6,
                             .bar = 14,
                             .text_gap = 6,
                             .node_gap = 28,
                             .channel_padding = 10,
                             .track = 10,
                             .overhang = 10,
                             .arrow = 18};

bool on_double(int x, int y, const std::vector<PlacedLine>& lines) {
  return std::any_of(lines.begin(), lines.end(), [&](const PlacedLine& line) {
    return line.doubled && line.y1 == y && line.x1 <= x && x <= line.x2;
  });
}

}  // namespace

SfcMetrics svg_sfc_metrics() {
  return metrics;
}

// Horizontal lines first; a vertical line that only passes another one interrupts it.
void SfcPainter::lines(const std::vector<PlacedLine>& lines) {
  svg_.open_group("sw-lines");
  for (const PlacedLine& line : lines) {
    if (line.y1 != line.y2) continue;
    if (line.doubled) {
      svg_.line(line.x1, line.y1 - 2, line.x2, line.y2 - 2, "sw-wire");
      svg_.line(line.x1, line.y1 + 2, line.x2, line.y2 + 2, "sw-wire");
    } else {
      svg_.line(line.x1, line.y1, line.x2, line.y2, "sw-wire");
    }
  }
  for (const PlacedLine& line : lines) {
    if (line.y1 != line.y2) halos(line, lines);
  }
  for (const PlacedLine& line : lines) {
    if (line.y1 == line.y2) continue;
    svg_.line(line.x1, line.y1 + (on_double(line.x1, line.y1, lines) ? 2 : 0), line.x2,
              line.y2 - (on_double(line.x2, line.y2, lines) ? 2 : 0), "sw-wire");
  }
  svg_.close_group();
}

void SfcPainter::halos(const PlacedLine& vertical, const std::vector<PlacedLine>& lines) {
  for (const PlacedLine& line : lines) {
    const bool passes = line.y1 == line.y2 && line.x1 <= vertical.x1 && vertical.x1 <= line.x2 &&
                        vertical.y1 < line.y1 && line.y1 < vertical.y2;
    if (passes) svg_.line(vertical.x1, line.y1 - 4, vertical.x1, line.y1 + 4, "sw-halo");
  }
}

void SfcPainter::step(const PlacedStep& placed, const std::string& jumps) {
  const Step& step = chart_.steps[placed.step.value];
  svg_.open_group("sw-step", "data-step", step.name);
  if (!step.comment.empty()) svg_.tooltip(step.comment);
  svg_.rect(placed.x, placed.y, placed.width, placed.height, "sw-box");
  if (step.initial) svg_.rect(placed.x + 4, placed.y + 4, placed.width - 8, placed.height - 8, "sw-inner");
  const int first = placed.y + metrics.step_padding_y + 12;
  svg_.text(placed.axis, first, step.name, "sw-name");
  if (!step.comment.empty()) svg_.text(placed.axis, first + metrics.line - 1, step.comment, "sw-comment");
  actions(placed);
  if (!jumps.empty()) entry(placed, jumps);
  svg_.close_group();
}

void SfcPainter::actions(const PlacedStep& placed) {
  if (placed.actions.empty()) return;
  const int wire = placed.y + metrics.action_row / 2;
  svg_.line(placed.x + placed.width, wire, placed.actions_x, wire, "sw-wire");
  for (const PlacedAction& action : placed.actions) {
    const int text = action.y + 15;
    svg_.rect(placed.actions_x, action.y, placed.qualifier_width, metrics.action_row, "sw-cell");
    svg_.text(placed.actions_x + placed.qualifier_width / 2, text, qualifier_text(*action.block),
              "sw-centre");
    const int x = placed.actions_x + placed.qualifier_width;
    svg_.rect(x, action.y, placed.target_width, metrics.action_row, "sw-cell");
    svg_.text(x + metrics.cell_padding, text, action.block->target, "sw-target");
  }
}

// Where jumps come in: an arrow from the left onto the line above the step.
void SfcPainter::entry(const PlacedStep& placed, const std::string& jumps) {
  const int y = placed.top + metrics.line / 2;
  const std::string tip = std::to_string(placed.axis) + " " + std::to_string(y);
  svg_.line(placed.axis - 2 * metrics.arrow, y, placed.axis - 8, y, "sw-wire");
  svg_.path("M" + tip + "l-9 -4v8z", "sw-arrow");
  svg_.text(placed.axis - 2 * metrics.arrow - metrics.text_gap, y + 4, jumps, "sw-label");
}

void SfcPainter::transition(const PlacedTransition& placed) {
  const Transition& transition = chart_.transitions[placed.transition];
  svg_.open_group("sw-transition", "data-transition", transition.name);
  if (!transition.comment.empty()) svg_.tooltip(transition.comment);
  svg_.line(placed.axis - metrics.bar, placed.y, placed.axis + metrics.bar, placed.y, "sw-bar");
  svg_.text(placed.axis - metrics.bar - metrics.text_gap, placed.y + 4, placed.label, "sw-label");
  for (std::size_t i = 0; i < placed.text.size(); ++i) {
    svg_.text(placed.axis + metrics.bar + metrics.text_gap, placed.y + 4 + static_cast<int>(i) * metrics.line,
              placed.text[i], "sw-condition");
  }
  svg_.close_group();
}

void SfcPainter::jump(const PlacedJump& jump, const std::string& name) {
  const std::string tip = std::to_string(jump.axis) + " " + std::to_string(jump.y + metrics.arrow);
  svg_.open_group("sw-jump");
  svg_.line(jump.axis, jump.y, jump.axis, jump.y + metrics.arrow - 8, "sw-wire");
  svg_.path("M" + tip + "l-5 -10h10z", "sw-arrow");
  svg_.text(jump.axis + metrics.bar, jump.y + metrics.arrow - 4, name, "sw-jump-name");
  svg_.close_group();
}

}  // namespace stepwright::graphic

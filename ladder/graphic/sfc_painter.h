#pragma once

// Paints the symbols of a laid out chart into an SVG: for one tall drawing or piece by piece onto pages. Not
// thread-safe; one per drawing.
//
//   const SfcLayout layout = lay_out(chart, svg_sfc_metrics());
//   SfcPainter painter(chart, svg);
//   painter.lines(layout.lines);
//   for (const PlacedStep& step : layout.steps) painter.step(step, step.jumps);

#include <string>
#include <vector>

#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/svg_writer.h"

namespace stepwright::graphic {

// Pixels; what the painter's styles (sfc_style) need.
SfcMetrics svg_sfc_metrics();

class SfcPainter {
 public:
  // Both must outlive the painter.
  SfcPainter(const SfcChart& chart, SvgWriter& svg) : chart_(chart), svg_(svg) {}

  // All lines of a drawing at once: they interrupt each other where they only pass.
  void lines(const std::vector<PlacedLine>& lines);
  // `jumps` names the transitions that jump here; empty = none.
  void step(const PlacedStep& placed, const std::string& jumps);
  void transition(const PlacedTransition& placed);
  // `name` stands beside the arrow: the step that it leads to.
  void jump(const PlacedJump& jump, const std::string& name);

 private:
  void halos(const PlacedLine& vertical, const std::vector<PlacedLine>& lines);
  void actions(const PlacedStep& placed);
  void entry(const PlacedStep& placed, const std::string& jumps);

  const SfcChart& chart_;
  SvgWriter& svg_;
};

}  // namespace stepwright::graphic

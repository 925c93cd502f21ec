#pragma once

// Paints the rungs of a laid out ladder diagram into an SVG: for one tall drawing or rung by rung onto pages.
// Not thread-safe; one per drawing.
//
//   const LadderLayout layout = lay_out(program, svg_ladder_metrics());
//   LadderPainter painter(program, layout, svg);
//   for (const PlacedRung& rung : layout.rungs) painter.rung(rung);

#include <map>
#include <string>

#include "ladder/graphic/ladder_layout.h"
#include "ladder/graphic/svg_writer.h"

namespace stepwright::graphic {

// Pixels; what the painter's styles (ladder_style) need.
LadderMetrics svg_ladder_metrics();

// Short texts below symbols, by the variable's name in upper case; LadderMetrics::note makes room for them.
struct LadderNotes {
  std::map<std::string, std::string> contacts;
  std::map<std::string, std::string> coils;
};

class LadderPainter {
 public:
  // All must outlive the painter.
  LadderPainter(const LadderProgram& program, const LadderLayout& layout, SvgWriter& svg,
                const LadderNotes* notes = nullptr)
      : program_(program), layout_(layout), svg_(svg), notes_(notes) {}

  // Without the rails.
  void rung(const PlacedRung& placed);
  void rails(int top, int bottom);

 private:
  void draw(const PlacedSymbol& symbol);
  void contact(const PlacedSymbol& symbol);
  void coil(const PlacedSymbol& symbol);
  void block(const PlacedSymbol& symbol);
  void row(const BlockShape& shape, const BlockRow& row, int x, int y);
  void goes_on(const PlacedSymbol& symbol);
  void note(const PlacedSymbol& symbol, const std::map<std::string, std::string>& texts,
            const std::string& variable);

  const LadderProgram& program_;
  const LadderLayout& layout_;
  SvgWriter& svg_;
  const LadderNotes* notes_;
};

}  // namespace stepwright::graphic

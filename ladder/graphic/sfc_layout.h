#pragma once

// The layout of a chart: where every symbol stands. Drawings and exchange formats share it; the unit is what
// SfcMetrics are in (pixels, characters). Pure function of its input; use from any thread.
//
//   SfcLayout layout = lay_out(chart, svg_metrics);

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::graphic {

// Sizes of the symbols.
struct SfcMetrics {
  int margin = 0;
  int character = 1;        // advance of one character of a name or condition
  int small_character = 1;  // of a comment or label
  int line = 1;             // height of a line of text
  int step_padding = 1;     // beside the text in a step
  int step_padding_y = 1;   // above and below it
  int min_step_width = 5;
  int action_gap = 2;                // between a step and its action blocks
  int action_row = 1;                // height of an action block
  int cell_padding = 1;              // beside the text in an action block
  int bar = 2;                       // half the length of a transition's bar
  int text_gap = 1;                  // between a symbol and its text
  int node_gap = 3;                  // between neighbours in a row
  int channel_padding = 1;           // above and below the lines between two rows
  int track = 1;                     // distance of two such lines
  int overhang = 1;                  // of a double line
  int arrow = 2;                     // length of the arrow of a jump
  int reference = 0;                 // characters kept free behind the name of a jump, for its page
  std::size_t condition_width = 40;  // characters after which a condition is wrapped
};

struct PlacedAction {
  const ActionBlock* block = nullptr;
  int y = 0;
};

struct PlacedStep {
  StepId step;
  int axis = 0;
  int top = 0;  // where its line comes in; above `y` if jumps lead here
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::vector<PlacedAction> actions;
  int actions_x = 0;
  int qualifier_width = 0;
  int target_width = 0;
  std::string jumps;  // names of the transitions that jump here, ", " between them
};

struct PlacedTransition {
  std::size_t transition = 0;
  std::string label;  // its name, or "#3" if it has none
  int axis = 0;
  int y = 0;  // of the bar
  std::vector<std::string> text;
};

struct PlacedJump {
  std::size_t transition = 0;
  StepId target;
  int axis = 0;
  int y = 0;  // where the arrow starts
};

// Horizontal or vertical; `doubled` is horizontal.
struct PlacedLine {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  bool doubled = false;
};

struct SfcLayout {
  int width = 0;
  int height = 0;
  std::vector<PlacedStep> steps;
  std::vector<PlacedTransition> transitions;
  std::vector<PlacedJump> jumps;
  std::vector<PlacedLine> lines;  // connections; they end at the symbols
};

// Requires a sound chart, which must live as long as the layout.
SfcLayout lay_out(const SfcChart& chart, const SfcMetrics& metrics);

// Label of a transition in a drawing: its name, or "#3" if it has none.
std::string drawn_label(const SfcChart& chart, std::size_t transition);

// "N", "L T#2s": what stands in the first cell of an action block.
std::string qualifier_text(const ActionBlock& block);

// Characters of a UTF-8 text.
std::size_t length_of(const std::string& text);

// A condition's text in lines of at most `width` characters where AND and OR allow it.
std::vector<std::string> wrap_condition(const std::string& text, std::size_t width);

}  // namespace stepwright::graphic

#include "ladder/graphic/sfc_layout.h"

#include <algorithm>

#include "ladder/graphic/sfc_graph.h"
#include "ladder/graphic/sfc_placement.h"
#include "ladder/graphic/sfc_routing.h"

namespace stepwright::graphic {
namespace {

int width_of(const std::string& text, int character) {
  return static_cast<int>(length_of(text)) * character;
}

// A text without parentheses around all of it; as it is if it holds strings.
std::string bare(std::string text) {
  while (text.size() > 2 && text.front() == '(' && text.find_first_of("'\"") == std::string::npos) {
    int depth = 0;
    std::size_t closes = 0;
    for (; closes < text.size(); ++closes) {
      if (text[closes] == '(') ++depth;
      if (text[closes] == ')' && --depth == 0) break;
    }
    if (closes + 1 != text.size()) break;
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

class Layouter {
 public:
  Layouter(const SfcChart& chart, const SfcMetrics& metrics)
      : chart_(chart), m_(metrics), graph_(layered_graph(chart)) {}

  SfcLayout run() {
    out_.steps.resize(chart_.steps.size());
    out_.transitions.resize(chart_.transitions.size());
    for (LayoutNode& node : graph_.nodes) measure(node);
    order_layers(graph_);
    place_axes(graph_, m_.node_gap);
    for (LayoutNode& node : graph_.nodes) {
      node.x += m_.margin;
      out_.width = std::max(out_.width, node.x + node.right + m_.margin);
    }
    place_rows();
    return std::move(out_);
  }

 private:
  void measure(LayoutNode& node) {
    if (node.kind == NodeKind::Step) measure_step(node);
    if (node.kind == NodeKind::Transition) measure_transition(node);
    if (node.kind == NodeKind::Jump) {
      node.left = m_.bar;
      node.right = m_.bar + m_.text_gap + width_of(chart_.steps[node.index].name, m_.character) +
                   m_.reference * m_.character;
      node.height = m_.arrow;
    }
  }

  void measure_step(LayoutNode& node) {
    const Step& step = chart_.steps[node.index];
    PlacedStep& placed = out_.steps[node.index];
    placed.step = StepId(node.index);
    const int text = std::max(width_of(step.name, m_.character), width_of(step.comment, m_.small_character));
    // An even number of units left and right of the axis.
    placed.width = std::max(m_.min_step_width, text + 2 * m_.step_padding) | 1;
    placed.height = 2 * m_.step_padding_y + (step.comment.empty() ? 1 : 2) * m_.line;
    node.left = placed.width / 2;
    node.right = placed.width - placed.width / 2;
    for (const ActionBlock& block : step.actions) {
      placed.actions.push_back({&block, 0});
      placed.qualifier_width = std::max(placed.qualifier_width,
                                        width_of(qualifier_text(block), m_.character) + 2 * m_.cell_padding);
      placed.target_width =
          std::max(placed.target_width, width_of(block.target, m_.character) + 2 * m_.cell_padding);
    }
    if (!step.actions.empty()) node.right += m_.action_gap + placed.qualifier_width + placed.target_width;
    node.height = std::max(placed.height, static_cast<int>(step.actions.size()) * m_.action_row);
    for (const std::uint32_t transition : graph_.jumps_into[node.index]) {
      placed.jumps += (placed.jumps.empty() ? "" : ", ") + drawn_label(chart_, transition);
    }
    if (placed.jumps.empty()) return;
    node.height += 2 * m_.line;
    const int references = static_cast<int>(graph_.jumps_into[node.index].size()) * m_.reference;
    node.left = std::max(node.left, 2 * m_.arrow + m_.text_gap + width_of(placed.jumps, m_.small_character) +
                                        references * m_.small_character);
  }

  void measure_transition(LayoutNode& node) {
    PlacedTransition& placed = out_.transitions[node.index];
    placed.transition = node.index;
    placed.label = drawn_label(chart_, node.index);
    placed.text = wrap_condition(bare(to_st(chart_.transitions[node.index].condition)), m_.condition_width);
    std::size_t longest = 0;
    for (const std::string& line : placed.text) longest = std::max(longest, length_of(line));
    node.left = m_.bar + m_.text_gap + width_of(placed.label, m_.small_character);
    node.right = m_.bar + m_.text_gap + static_cast<int>(longest) * m_.character;
    node.height = static_cast<int>(placed.text.size()) * m_.line;
  }

  void place_rows() {
    int y = m_.margin;
    for (std::size_t layer = 0; layer < graph_.layers.size(); ++layer) {
      const int height = row_height(layer);
      for (const std::size_t node : graph_.layers[layer]) place(graph_.nodes[node], y, height);
      y += height;
      if (layer + 1 < graph_.layers.size()) y = place_channel(layer, y);
    }
    out_.height = y + m_.margin;
  }

  int row_height(std::size_t layer) const {
    int height = 0;
    for (const std::size_t node : graph_.layers[layer]) height = std::max(height, graph_.nodes[node].height);
    return height;
  }

  void vertical(int x, int y1, int y2) {
    if (y1 < y2) out_.lines.push_back({x, y1, x, y2, false});
  }

  void place(const LayoutNode& node, int y, int row) {
    if (node.kind == NodeKind::Pass) vertical(node.x, y, y + row);
    if (node.kind == NodeKind::Step) place_step(node, y, row);
    if (node.kind == NodeKind::Transition) {
      PlacedTransition& placed = out_.transitions[node.index];
      placed.axis = node.x;
      placed.y = y + m_.line / 2;
      vertical(node.x, y, y + row);
    }
    if (node.kind == NodeKind::Jump) {
      out_.jumps.push_back({graph_.nodes[node.up[0]].index, StepId(node.index), node.x, y});
    }
  }

  void place_step(const LayoutNode& node, int y, int row) {
    PlacedStep& placed = out_.steps[node.index];
    placed.axis = node.x;
    placed.top = y;
    placed.x = node.x - placed.width / 2;
    placed.y = placed.jumps.empty() ? y : y + 2 * m_.line;
    placed.actions_x = placed.x + placed.width + m_.action_gap;
    for (std::size_t i = 0; i < placed.actions.size(); ++i) {
      placed.actions[i].y = placed.y + static_cast<int>(i) * m_.action_row;
    }
    vertical(node.x, y, placed.y);
    if (!node.down.empty()) vertical(node.x, placed.y + placed.height, y + row);
  }

  int place_channel(std::size_t layer, int y) {
    const Channel channel = route_channel(graph_, layer, m_.overhang);
    const int tracks = static_cast<int>(channel.tracks);
    const int bottom = y + 2 * m_.channel_padding + std::max(0, tracks - 1) * m_.track;
    const auto track_y = [&](std::size_t line) {
      return y + m_.channel_padding + static_cast<int>(channel.lines[line].track) * m_.track;
    };
    for (std::size_t i = 0; i < channel.lines.size(); ++i) {
      const ChannelLine& line = channel.lines[i];
      out_.lines.push_back({line.x1, track_y(i), line.x2, track_y(i), line.doubled});
    }
    for (const ChannelDrop& drop : channel.drops) {
      const int y1 = drop.from == ChannelDrop::layer ? y : track_y(drop.from);
      const int y2 = drop.to == ChannelDrop::layer ? bottom : track_y(drop.to);
      out_.lines.push_back({drop.x, std::min(y1, y2), drop.x, std::max(y1, y2), false});
    }
    return bottom;
  }

  const SfcChart& chart_;
  const SfcMetrics& m_;
  LayeredGraph graph_;
  SfcLayout out_;
};

}  // namespace

SfcLayout lay_out(const SfcChart& chart, const SfcMetrics& metrics) {
  return Layouter(chart, metrics).run();
}

std::string drawn_label(const SfcChart& chart, std::size_t transition) {
  const std::string& name = chart.transitions[transition].name;
  return name.empty() ? "#" + std::to_string(transition + 1) : name;
}

std::string qualifier_text(const ActionBlock& block) {
  std::string text = to_string(block.qualifier);
  if (!block.duration.empty()) text += " " + block.duration;
  return text;
}

std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::string> wrap_condition(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t begin = 0; begin < text.size();) {
    // A piece runs up to the next operator.
    const std::size_t next = std::min(text.find(" AND ", begin + 1), text.find(" OR ", begin + 1));
    const std::string piece = text.substr(begin, next == std::string::npos ? next : next - begin);
    if (!lines.back().empty() && length_of(lines.back()) + length_of(piece) > width) {
      lines.push_back(piece.substr(1));
    } else {
      lines.back() += piece;
    }
    begin = next == std::string::npos ? text.size() : next;
  }
  return lines;
}

}  // namespace stepwright::graphic

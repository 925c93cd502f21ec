#include "ladder/print/chart_tiles.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "ladder/graphic/sfc_painter.h"
#include "ladder/print/cuts.h"

namespace stepwright::print {

namespace {

using graphic::PlacedJump;
using graphic::PlacedLine;
using graphic::PlacedStep;
using graphic::PlacedTransition;

// Around a tile, for its references.
constexpr int kMargin = 30;
// Letters of 12 pixels are 1.9 mm high then; the smallest of ISO 3098 are 1.8 mm.
constexpr int kReadablePercent = 60;
// Characters of a line of a condition.
constexpr std::size_t kConditionWidths[] = {40, 26, 16};

graphic::SfcMetrics metrics(std::size_t condition_width = kConditionWidths[0]) {
  graphic::SfcMetrics result = graphic::svg_sfc_metrics();
  result.reference = 5;
  result.condition_width = condition_width;
  return result;
}

int width_of(const std::string& text, int character) {
  return static_cast<int>(graphic::length_of(text)) * character;
}

Box box_of(const PlacedStep& step, const graphic::SfcMetrics& m) {
  int bottom = step.y + step.height;
  if (!step.actions.empty()) bottom = std::max(bottom, step.actions.back().y + m.action_row);
  int left = step.x;
  if (!step.jumps.empty())
    left = std::min(left, step.axis - 2 * m.arrow - m.text_gap - width_of(step.jumps, m.small_character));
  const int right =
      step.actions.empty() ? step.x + step.width : step.actions_x + step.qualifier_width + step.target_width;
  return {{left - 2, right + 2}, {step.top - 2, bottom + 2}};
}

Box box_of(const PlacedTransition& transition, const graphic::SfcMetrics& m) {
  int right = 0;
  for (const std::string& line : transition.text) right = std::max(right, width_of(line, m.character));
  const int lines = std::max(1, static_cast<int>(transition.text.size()));
  return {{transition.axis - m.bar - m.text_gap - width_of(transition.label, m.small_character) - 2,
           transition.axis + m.bar + m.text_gap + right + 2},
          {transition.y - m.line / 2 - 2, transition.y + lines * m.line}};
}

Box box_of(const PlacedJump& jump, const graphic::SfcMetrics& m, const std::string& name) {
  const int text = width_of(name, m.character) + m.reference * m.character;
  return {{jump.axis - m.bar, jump.axis + m.bar + text}, {jump.y - 2, jump.y + m.arrow + 2}};
}

std::vector<Box> boxes_of(const graphic::SfcLayout& layout, const graphic::SfcChart& chart) {
  const graphic::SfcMetrics m = metrics();
  std::vector<Box> boxes;
  for (const PlacedStep& each : layout.steps) boxes.push_back(box_of(each, m));
  for (const PlacedTransition& each : layout.transitions) boxes.push_back(box_of(each, m));
  for (const PlacedJump& each : layout.jumps)
    boxes.push_back(box_of(each, m, chart.steps[each.target.value].name));
  return boxes;
}

bool is_horizontal(const PlacedLine& line) {
  return line.y1 == line.y2;
}

bool overlap(Interval a, Interval b) {
  return a.begin < b.end && b.begin < a.end;
}

}  // namespace

ChartTiles::ChartTiles(const graphic::SfcChart& chart, int width, int height) : chart_(&chart) {
  std::optional<ChartTiles> best;
  int least = 0;
  for (const std::size_t condition_width : kConditionWidths) {
    layout_ = lay_out(chart, metrics(condition_width));
    for (percent_ = 100; percent_ > 10; percent_ -= 5) {
      // Smaller than readable only where nothing else is left.
      if (percent_ < kReadablePercent && best) break;
      if (!cut(width * 100 / percent_, height * 100 / percent_)) continue;
      number_crossings();
      const int own = cost(height) + static_cast<int>(kConditionWidths[0] - condition_width);
      if (!best || own < least) best = *this, least = own;
      if (tiles_.size() == 1) break;
    }
  }
  if (best) {
    *this = std::move(*best);
  } else {
    // Nothing can be cut: as small as it takes.
    tiles_ = {{0, 0, layout_.width, layout_.height}};
    percent_ = std::max(
        1, std::min({100, width * 100 / layout_.width, height * 100 / (layout_.height + 2 * kMargin)}));
    number_crossings();
  }
  pages_.resize(tiles_.size(), 0);
}

int ChartTiles::cost(int height) const {
  int pages = 1;
  int used = 0;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const int own = height_of(i);
    if (used > 0 && used + own > height) {
      ++pages;
      used = 0;
    }
    used += own;
  }
  const int cut_lines = static_cast<int>(crossings_.size());
  return 1000 * pages + 40 * static_cast<int>(tiles_.size()) + 15 * cut_lines + 4 * (100 - percent_);
}

// Bands from top to bottom, each of them then from left to right. A band is as high as it can be while it can
// still be cut from top to bottom.
bool ChartTiles::cut(int width, int height) {
  tiles_.clear();
  const std::vector<Box> boxes = boxes_of(layout_, *chart_);
  std::vector<Interval> rows;
  for (const Box& each : boxes) rows.push_back(each.y);
  for (const PlacedLine& each : layout_.lines)
    if (is_horizontal(each)) rows.push_back({each.y1 - 5, each.y1 + 5});
  const std::vector<int> ends = gaps(std::move(rows), layout_.height);
  int y1 = 0;
  for (std::size_t next = 0; next < ends.size();) {
    std::size_t last = next;
    while (last < ends.size() && ends[last] - y1 <= height - 2 * kMargin) ++last;
    std::vector<Box> near;
    for (const Box& each : boxes)
      if (last > next && overlap(each.y, {y1, ends[last - 1]})) near.push_back(each);
    while (last > next && !cut_band(near, {y1, ends[last - 1]}, width)) --last;
    if (last == next) {
      tiles_.clear();
      return false;
    }
    y1 = ends[last - 1];
    next = last;
  }
  return true;
}

bool ChartTiles::cut_band(const std::vector<Box>& boxes, Interval band, int width) {
  std::vector<int> columns{0, layout_.width};
  if (layout_.width > width) {
    std::vector<Interval> intervals;
    for (const Box& each : boxes)
      if (overlap(each.y, band)) intervals.push_back(each.x);
    for (const PlacedLine& each : layout_.lines)
      if (!is_horizontal(each) && overlap({each.y1, each.y2}, band))
        intervals.push_back({each.x1 - 5, each.x1 + 5});
    auto found = cuts(std::move(intervals), layout_.width, width - 2 * kMargin);
    if (!found) return false;
    columns = std::move(*found);
  }
  for (std::size_t k = 0; k + 1 < columns.size(); ++k)
    tiles_.push_back({columns[k], band.begin, columns[k + 1], band.end});
  return true;
}

// Both ends of a cut line have the same number; numbers begin anew at every cut.
void ChartTiles::number_crossings() {
  crossings_.clear();
  std::map<std::pair<bool, int>, int> used;  // per cut, the two directions apart
  for (const Tile& tile : tiles_) {
    for (const PlacedLine& line : layout_.lines) {
      const bool inside = line.x1 < tile.x2 && line.x2 >= tile.x1 && line.y1 < tile.y2 && line.y2 >= tile.y1;
      if (!inside) continue;
      if (!is_horizontal(line) && line.y2 > tile.y2 && crossings_.count({line.x1, tile.y2}) == 0)
        crossings_[{line.x1, tile.y2}] = ++used[{false, tile.y2}];
      if (is_horizontal(line) && line.x2 > tile.x2 && crossings_.count({tile.x2, line.y1}) == 0)
        crossings_[{tile.x2, line.y1}] = ++used[{true, tile.x2}];
    }
  }
}

int ChartTiles::height_of(std::size_t tile) const {
  return (tiles_[tile].y2 - tiles_[tile].y1 + 2 * kMargin) * percent_ / 100;
}

std::size_t ChartTiles::tile_at(int x, int y) const {
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const Tile& each = tiles_[i];
    if (each.x1 <= x && x < each.x2 && each.y1 <= y && y < each.y2) return i;
  }
  return tiles_.size() - 1;
}

std::string ChartTiles::reference(int x, int y, std::size_t other) const {
  const auto found = crossings_.find({x, y});
  assert(found != crossings_.end());
  return "/" + std::to_string(pages_[other]) + "." + std::to_string(found->second);
}

// " /3" if the place is on another page.
std::string ChartTiles::page_of(int x, int y, std::size_t from) const {
  const std::size_t tile = tile_at(x, y);
  return pages_[tile] == pages_[from] ? "" : " /" + std::to_string(pages_[tile]);
}

void ChartTiles::draw(graphic::SvgWriter& svg, std::size_t tile, int x, int y) const {
  const Tile& area = tiles_[tile];
  // Only a cut at the left needs room there.
  const int left = area.x1 > 0 ? area.x1 - kMargin : 0;
  svg.open_moved(x - left * percent_ / 100, y - (area.y1 - kMargin) * percent_ / 100, percent_);
  draw_lines(svg, tile);
  draw_symbols(svg, tile);
  svg.close_group();
}

void ChartTiles::draw_lines(graphic::SvgWriter& svg, std::size_t tile) const {
  const Tile& area = tiles_[tile];
  std::vector<PlacedLine> clipped;
  for (const PlacedLine& line : layout_.lines) {
    const bool inside = line.x1 < area.x2 && line.x2 >= area.x1 && line.y1 < area.y2 && line.y2 >= area.y1;
    if (!inside) continue;
    clipped.push_back({std::max(line.x1, area.x1), std::max(line.y1, area.y1), std::min(line.x2, area.x2),
                       std::min(line.y2, area.y2), line.doubled});
    draw_references(svg, line, area);
  }
  graphic::SfcPainter(*chart_, svg).lines(clipped);
}

void ChartTiles::draw_references(graphic::SvgWriter& svg, const PlacedLine& line, const Tile& tile) const {
  const auto arrow = [&svg](int x, int y, const char* shape) {
    svg.path("M" + std::to_string(x) + " " + std::to_string(y) + shape, "sw-arrow");
  };
  if (!is_horizontal(line)) {
    const int x = line.x1;
    if (line.y2 > tile.y2) {
      arrow(x, tile.y2, "m-5 0h10l-5 9z");
      svg.text(x, tile.y2 + 20, reference(x, tile.y2, tile_at(x, tile.y2)), "sw-reference");
    }
    if (line.y1 < tile.y1) {
      arrow(x, tile.y1 - 9, "m-5 0h10l-5 9z");
      svg.text(x, tile.y1 - 13, reference(x, tile.y1, tile_at(x, tile.y1 - 1)), "sw-reference");
    }
    return;
  }
  const int y = line.y1;
  if (line.x2 > tile.x2) {
    arrow(tile.x2, y, "m0 -5v10l9 -5z");
    svg.text(tile.x2 + 16, y - 8, reference(tile.x2, y, tile_at(tile.x2, y)), "sw-reference");
  }
  if (line.x1 < tile.x1) {
    arrow(tile.x1, y, "m0 -5v10l-9 -5z");
    svg.text(tile.x1 - 14, y - 8, reference(tile.x1, y, tile_at(tile.x1 - 1, y)), "sw-reference");
  }
}

void ChartTiles::draw_symbols(graphic::SvgWriter& svg, std::size_t tile) const {
  const Tile& area = tiles_[tile];
  const auto here = [&area](int x, int y) {
    return area.x1 <= x && x < area.x2 && area.y1 <= y && y < area.y2;
  };
  graphic::SfcPainter painter(*chart_, svg);
  for (const PlacedStep& each : layout_.steps)
    if (here(each.axis, each.y)) painter.step(each, jumps_into(each, tile));
  for (const PlacedTransition& each : layout_.transitions)
    if (here(each.axis, each.y)) painter.transition(each);
  for (const PlacedJump& each : layout_.jumps) {
    if (!here(each.axis, each.y)) continue;
    const PlacedStep& target = layout_.steps[each.target.value];
    painter.jump(each, chart_->steps[each.target.value].name + page_of(target.axis, target.y, tile));
  }
}

std::string ChartTiles::jumps_into(const PlacedStep& step, std::size_t tile) const {
  std::string text;
  for (const PlacedJump& each : layout_.jumps) {
    if (each.target != step.step) continue;
    text += (text.empty() ? "" : ", ") + graphic::drawn_label(*chart_, each.transition) +
            page_of(each.axis, each.y, tile);
  }
  return text;
}

}  // namespace stepwright::print

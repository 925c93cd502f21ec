#include "cell/hmi/terminal_drawing.h"

#include <algorithm>
#include <vector>

#include "runtime/ground/markup/xml_text.h"

namespace stepwright::hmi {
namespace {

using markup::xml_escaped;

constexpr std::size_t kMostLines = 40;
constexpr int kLine = 26;     // px, from one text to the next
constexpr int kTop = 64;      // px, of the first line
constexpr int kWidth = 900;   // px
constexpr int kMiddle = 450;  // px, where the right side begins
constexpr int kNumber = 150;  // px, from the names of a side to its numbers

struct Line {
  std::string name;
  std::string point;
  std::string unit;
  bool is_switch = false;
};

std::string text_at(int x, int y, const std::string& attributes, const std::string& text) {
  return "  <text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" fill=\"var(--text)\"" +
         attributes + ">" + xml_escaped(text) + "</text>\n";
}

// A switch is a lamp, all else a number.
std::string drawn(const Line& line, int x, int y) {
  std::string svg = text_at(x, y, " font-size=\"15\"", line.name);
  if (line.point.empty()) return svg + text_at(x + kNumber + 60, y, " font-size=\"15\"", "-");
  const std::string title = "<title>" + xml_escaped(line.name) + "</title>";
  if (line.is_switch) {
    return svg + "  <circle cx=\"" + std::to_string(x + kNumber + 66) + "\" cy=\"" + std::to_string(y - 5) +
           "\" r=\"8\" fill=\"var(--panel)\" stroke=\"var(--line-strong)\" data-on=\"" +
           xml_escaped(line.point) + "\">" + title + "</circle>\n";
  }
  return svg + "  <text x=\"" + std::to_string(x + kNumber + 60) + "\" y=\"" + std::to_string(y) +
         "\" font-size=\"15\" fill=\"var(--text)\" data-text=\"" + xml_escaped(line.point) +
         "\" data-digits=\"3\" data-unit=\"" + xml_escaped(line.unit) + "\">-</text>\n";
}

std::string side(const char* heading, const std::vector<Line>& lines, int x) {
  std::string svg = text_at(x, kTop - 26, " font-size=\"13\"", heading);
  int y = kTop;
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i, y += kLine)
    svg += drawn(lines[i], x, y);
  if (lines.size() > kMostLines)
    svg += text_at(x, y, " font-size=\"13\"", "+ " + std::to_string(lines.size() - kMostLines));
  return svg;
}

// A drawing binds to names without blanks; those of terminals may have some.
std::string id_of(const std::string& name, const PicturePoints& points) {
  std::string id = name;
  std::ranges::replace_if(
      id, [](unsigned char c) { return c <= ' '; }, '_');
  while (std::ranges::find(points.points, id, &protocol::Point::id) != points.points.end()) id += '_';
  return id;
}

std::vector<Line> lines_of(const std::vector<config::SteppedTerminalConfig>& terminals, bool measured,
                           PicturePoints& points) {
  std::vector<Line> lines;
  for (const config::SteppedTerminalConfig& each : terminals) {
    std::string point;
    const std::string id = id_of(each.name, points);
    if (each.is_switch) {
      point = points.terminal(id, each.name);
    } else if (measured) {
      point = points.truth(id, each.name, each.unit, true, each.name);
    } else {
      point = points.add(id, each.name, each.unit, false,
                         {{server::PointSourceKind::Address, each.address, each.per_count, each.at_zero}});
    }
    lines.push_back({each.name, std::move(point), each.unit, each.is_switch});
  }
  return lines;
}

}  // namespace

std::string terminal_drawing(const std::string& title, const config::SteppedPlantConfig& plant,
                             PicturePoints& points) {
  const std::vector<Line> left = lines_of(plant.actuators, false, points);
  std::vector<Line> right = lines_of(plant.sensors, true, points);
  for (const config::SteppedQuantityConfig& value : plant.values)
    right.push_back({value.name,
                     points.truth(id_of(value.name, points), value.name, value.unit, true, value.name),
                     value.unit});
  const std::size_t rows = std::min(std::max(left.size(), right.size()), kMostLines + 1);
  const int height = kTop + static_cast<int>(rows) * kLine + 20;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(kWidth) +
                    " " + std::to_string(height) + "\">\n  <title>" + xml_escaped(title) + "</title>\n";
  svg += "  <rect x=\"10\" y=\"10\" width=\"" + std::to_string(kWidth - 20) + "\" height=\"" +
         std::to_string(height - 20) + "\" rx=\"6\" fill=\"var(--panel)\" stroke=\"var(--line-strong)\"/>\n";
  svg += side("actuators", left, 30) + side("sensors, values", right, kMiddle);
  return svg + "</svg>\n";
}

}  // namespace stepwright::hmi

#include "tests/unit/ladder/print/page_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <pugixml.hpp>

namespace stepwright::print {
namespace {

struct Move {
  double x = 0;
  double y = 0;
  double scale = 1;
};

double size_of(const std::string& css) {
  static const std::map<std::string, double> sizes{
      {"sw-small", 8},         {"sw-sheet", 15}, {"sw-head", 11},     {"sw-cell-text", 11},
      {"sw-code", 11},         {"sw-line", 10},  {"sw-reference", 9}, {"sw-number", 11},
      {"sw-rung-comment", 11}, {"sw-note", 9},   {"sw-comment", 10},  {"sw-label", 10}};
  const auto found = sizes.find(css);
  return found == sizes.end() ? 12 : found->second;
}

// Where the text ends up left of its place: 0 start, 0.5 middle, 1 end.
double anchor_of(const std::string& css) {
  for (const char* each : {"sw-centre", "sw-title", "sw-name", "sw-comment", "sw-note", "sw-reference"})
    if (css == each) return 0.5;
  for (const char* each : {"sw-end", "sw-label", "sw-line"})
    if (css == each) return 1;
  return 0;
}

std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

void collect(pugi::xml_node node, Move move, std::vector<PageText>& texts) {
  double x = 0;
  double y = 0;
  double scale = 1;
  if (std::sscanf(node.attribute("transform").value(), "translate(%lf,%lf) scale(%lf)", &x, &y, &scale) >=
      2) {
    move = {move.x + x * move.scale, move.y + y * move.scale, move.scale * scale};
  }
  for (const pugi::xml_node child : node.children()) {
    if (std::string(child.name()) != "text") {
      collect(child, move, texts);
      continue;
    }
    const std::string text = child.text().get();
    const std::string css = child.attribute("class").value();
    if (text.find_first_not_of(' ') == std::string::npos) continue;
    const double size = size_of(css);
    // The advance of the fonts that the style names is 0.602 of their size.
    const double width = 0.602 * size * static_cast<double>(characters(text));
    const double left = child.attribute("x").as_double() - width * anchor_of(css);
    const double base = child.attribute("y").as_double();
    texts.push_back({text, move.x + left * move.scale, move.y + (base - 0.7 * size) * move.scale,
                     move.x + (left + width) * move.scale, move.y + base * move.scale});
  }
}

}  // namespace

std::vector<PageText> texts_of_page(const std::string& svg, int page, int page_height) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_ws_pcdata_single));
  const std::string path = "//g[@class='sw-page'][@data-page='" + std::to_string(page) + "']";
  std::vector<PageText> texts;
  collect(document.select_node(path.c_str()).node(), {0, -1.0 * page_height * (page - 1), 1}, texts);
  return texts;
}

int page_count(const std::string& svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  return static_cast<int>(document.select_nodes("//g[@class='sw-page']").size());
}

std::vector<std::string> faults_of_page(const std::vector<PageText>& texts, int width, int height) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const PageText& a = texts[i];
    if (a.x1 < 76 || a.y1 < 38 || a.x2 > width - 38 || a.y2 > height - 38) faults.push_back(a.text);
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      const PageText& b = texts[j];
      const bool overlap = a.x1 < b.x2 && b.x1 < a.x2 && a.y1 < b.y2 && b.y1 < a.y2;
      if (overlap) faults.push_back(a.text + " | " + b.text);
    }
  }
  return faults;
}

}  // namespace stepwright::print

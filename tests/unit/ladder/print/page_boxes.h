#pragma once

// The texts and boxes of a print, measured: what overlaps or leaves its page.

#include <string>
#include <vector>

namespace stepwright::print {

struct PageText {
  std::string text;
  double x1 = 0;
  double y1 = 0;
  double x2 = 0;
  double y2 = 0;
};

// Texts of one page (from 1) in pixels of the page. Fails the test if the SVG is not well-formed.
std::vector<PageText> texts_of_page(const std::string& svg, int page, int page_height = 1123);
int page_count(const std::string& svg);

// "a | b" for every two texts that overlap, "a" for every one outside of the frame.
std::vector<std::string> faults_of_page(const std::vector<PageText>& texts, int width = 794,
                                        int height = 1123);

}  // namespace stepwright::print

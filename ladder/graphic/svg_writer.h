#pragma once

// Writes the elements of an SVG: the writer for the drawings, the escaping for everyone.

#include <string>

namespace stepwright::graphic {

class SvgWriter {
 public:
  // `style` is the content of the style element. On paper `width_mm` says how wide it is; 0 = in pixels.
  SvgWriter(int width, int height, const std::string& title, const std::string& style, int width_mm = 0,
            int height_mm = 0);

  void open_group(const std::string& css, const std::string& attribute = {}, const std::string& value = {});
  // A group whose coordinates are scaled by `percent` / 100 (at most 100) and then moved.
  void open_moved(int x, int y, int percent = 100);
  void close_group();
  void tooltip(const std::string& text);  // of the open group
  void rect(int x, int y, int width, int height, const std::string& css);
  void line(int x1, int y1, int x2, int y2, const std::string& css);
  void path(const std::string& data, const std::string& css);
  // `css` decides size and anchor.
  void text(int x, int y, const std::string& text, const std::string& css);
  // The same with all its blanks.
  void code(int x, int y, const std::string& text, const std::string& css);
  std::string finish();

 private:
  std::string out_;
};

}  // namespace stepwright::graphic

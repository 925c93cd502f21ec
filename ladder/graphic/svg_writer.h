#pragma once

// Writes the elements of an SVG: the writer for the drawings of this folder, the escaping for everyone.

#include <string>

namespace stepwright::graphic {

class SvgWriter {
 public:
  // `style` is the content of the style element.
  SvgWriter(int width, int height, const std::string& title, const std::string& style);

  void open_group(const std::string& css, const std::string& attribute = {}, const std::string& value = {});
  void close_group();
  void tooltip(const std::string& text);  // of the open group
  void rect(int x, int y, int width, int height, const std::string& css);
  void line(int x1, int y1, int x2, int y2, const std::string& css);
  void path(const std::string& data, const std::string& css);
  // `css` decides size and anchor.
  void text(int x, int y, const std::string& text, const std::string& css);
  std::string finish();

 private:
  std::string out_;
};

// Escapes what XML reserves; control characters become spaces.
std::string xml_escaped(const std::string& text);

}  // namespace stepwright::graphic

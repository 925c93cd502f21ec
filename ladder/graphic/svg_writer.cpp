#include "ladder/graphic/svg_writer.h"

#include <cassert>

#include "runtime/ground/markup/xml_text.h"

namespace stepwright::graphic {

using markup::xml_escaped;

namespace {

std::string number(int value) {
  return '"' + std::to_string(value) + '"';
}

}  // namespace

SvgWriter::SvgWriter(int width, int height, const std::string& title, const std::string& style, int width_mm,
                     int height_mm) {
  const std::string size = std::to_string(width) + " " + std::to_string(height);
  const std::string unit = width_mm > 0 ? "mm" : "";
  const std::string outer = " width=\"" + std::to_string(width_mm > 0 ? width_mm : width) + unit +
                            "\" height=\"" + std::to_string(width_mm > 0 ? height_mm : height) + unit + "\"";
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + "\"" + outer +
         " class=\"sw-drawing\" role=\"img\">\n<title>" + xml_escaped(title) + "</title>\n<style>\n" + style +
         "</style>\n<rect class=\"sw-paper\" width=" + number(width) + " height=" + number(height) + "/>\n";
}

void SvgWriter::open_group(const std::string& css, const std::string& attribute, const std::string& value) {
  out_ += "<g class=\"" + css + "\"";
  if (!attribute.empty()) out_ += " " + attribute + "=\"" + xml_escaped(value) + "\"";
  out_ += ">\n";
}

void SvgWriter::open_moved(int x, int y, int percent) {
  out_ += "<g transform=\"translate(" + std::to_string(x) + "," + std::to_string(y) + ")";
  assert(0 < percent && percent <= 100);
  if (percent < 100) out_ += " scale(0." + std::to_string(100 + percent).substr(1) + ")";
  out_ += "\">\n";
}

void SvgWriter::close_group() {
  out_ += "</g>\n";
}

void SvgWriter::tooltip(const std::string& text) {
  out_ += "<title>" + xml_escaped(text) + "</title>\n";
}

void SvgWriter::rect(int x, int y, int width, int height, const std::string& css) {
  out_ += "<rect class=\"" + css + "\" x=" + number(x) + " y=" + number(y) + " width=" + number(width) +
          " height=" + number(height) + "/>\n";
}

void SvgWriter::line(int x1, int y1, int x2, int y2, const std::string& css) {
  out_ += "<line class=\"" + css + "\" x1=" + number(x1) + " y1=" + number(y1) + " x2=" + number(x2) +
          " y2=" + number(y2) + "/>\n";
}

void SvgWriter::path(const std::string& data, const std::string& css) {
  out_ += "<path class=\"" + css + "\" d=\"" + data + "\"/>\n";
}

void SvgWriter::text(int x, int y, const std::string& text, const std::string& css) {
  out_ += "<text class=\"" + css + "\" x=" + number(x) + " y=" + number(y) + ">" + xml_escaped(text) +
          "</text>\n";
}

void SvgWriter::code(int x, int y, const std::string& text, const std::string& css) {
  out_ += "<text class=\"" + css + "\" xml:space=\"preserve\" x=" + number(x) + " y=" + number(y) + ">" +
          xml_escaped(text) + "</text>\n";
}

std::string SvgWriter::finish() {
  return out_ + "</svg>\n";
}

}  // namespace stepwright::graphic

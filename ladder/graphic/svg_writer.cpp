#include "ladder/graphic/svg_writer.h"

#include <algorithm>
#include <cassert>

namespace stepwright::graphic {
namespace {

std::string number(int value) {
  return '"' + std::to_string(value) + '"';
}

// Bytes of the character at `at` if XML may hold it; 0 for a byte that begins none (RFC 3629).
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto byte = [&text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  unsigned code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (byte(at + i) & 0x3FU);
  }
  constexpr unsigned smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < smallest[length] || code > 0x10FFFF || surrogate || code == 0xFFFE || code == 0xFFFF ? 0
                                                                                                     : length;
}

}  // namespace

bool is_xml_text(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    const char c = text[i];
    const bool control = length == 1 && static_cast<unsigned char>(c) < 0x20;
    if (length == 0 || (control && c != '\t' && c != '\n' && c != '\r')) return false;
    i += length;
  }
  return true;
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t length = character_length(text, i);
    if (length != 1) {
      result += length == 0 ? "\xEF\xBF\xBD" : text.substr(i, length);
      i += std::max<std::size_t>(length, 1);
      continue;
    }
    ++i;
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

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

#include "hmi_web/drawing/vocabulary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

namespace stepwright::drawing {
namespace {

constexpr std::array<std::string_view, 23> kElements = {
    "svg",    "g",     "defs",           "symbol",         "use",  "title",    "desc",
    "path",   "rect",  "circle",         "ellipse",        "line", "polyline", "polygon",
    "text",   "tspan", "linearGradient", "radialGradient", "stop", "clipPath", "pattern",
    "marker", "image"};
constexpr std::array<std::string_view, 2> kSilent = {"metadata", "view"};

constexpr std::array<std::string_view, 41> kGeometry = {"viewBox",
                                                        "preserveAspectRatio",
                                                        "x",
                                                        "y",
                                                        "x1",
                                                        "y1",
                                                        "x2",
                                                        "y2",
                                                        "cx",
                                                        "cy",
                                                        "r",
                                                        "rx",
                                                        "ry",
                                                        "fx",
                                                        "fy",
                                                        "dx",
                                                        "dy",
                                                        "d",
                                                        "points",
                                                        "width",
                                                        "height",
                                                        "transform",
                                                        "offset",
                                                        "gradientUnits",
                                                        "gradientTransform",
                                                        "spreadMethod",
                                                        "clipPathUnits",
                                                        "patternUnits",
                                                        "patternContentUnits",
                                                        "patternTransform",
                                                        "markerWidth",
                                                        "markerHeight",
                                                        "markerUnits",
                                                        "refX",
                                                        "refY",
                                                        "orient",
                                                        "textLength",
                                                        "lengthAdjust",
                                                        "rotate",
                                                        "pathLength",
                                                        "role"};
constexpr std::array<std::string_view, 38> kPresentation = {"fill",
                                                            "fill-opacity",
                                                            "fill-rule",
                                                            "stroke",
                                                            "stroke-width",
                                                            "stroke-opacity",
                                                            "stroke-linecap",
                                                            "stroke-linejoin",
                                                            "stroke-miterlimit",
                                                            "stroke-dasharray",
                                                            "stroke-dashoffset",
                                                            "opacity",
                                                            "color",
                                                            "display",
                                                            "visibility",
                                                            "stop-color",
                                                            "stop-opacity",
                                                            "font-family",
                                                            "font-size",
                                                            "font-style",
                                                            "font-weight",
                                                            "font-variant",
                                                            "font-stretch",
                                                            "text-anchor",
                                                            "text-decoration",
                                                            "letter-spacing",
                                                            "word-spacing",
                                                            "dominant-baseline",
                                                            "baseline-shift",
                                                            "clip-path",
                                                            "clip-rule",
                                                            "marker-start",
                                                            "marker-mid",
                                                            "marker-end",
                                                            "vector-effect",
                                                            "paint-order",
                                                            "shape-rendering",
                                                            "text-rendering"};

// Of a drawing's own units: beyond it a browser computes with what is left of a float.
constexpr double kFarthest = 1e6;

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string lower_without_space(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (static_cast<unsigned char>(c) > ' ')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// "amp", "#176", "#xB0".
bool is_known_entity(std::string_view name) {
  constexpr std::array<std::string_view, 5> kKnown = {"amp", "lt", "gt", "quot", "apos"};
  if (is_among(kKnown, name)) return true;
  if (!name.starts_with('#')) return false;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  return !name.empty() && std::ranges::all_of(name, [&](unsigned char c) {
    return hexadecimal ? std::isxdigit(c) != 0 : std::isdigit(c) != 0;
  });
}

// Behind the comment, the CDATA or the instruction that begins at `at`; `at` itself: none does.
std::size_t end_of_plain(std::string_view text, std::size_t at) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kPlain = {
      {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
  for (const auto& [begin, end] : kPlain) {
    if (!text.substr(at).starts_with(begin)) continue;
    const std::size_t found = text.find(end, at + begin.size());
    return found == std::string_view::npos ? text.size() : found + end.size();
  }
  return at;
}

}  // namespace

Standing standing_of_element(std::string_view name) {
  if (is_among(kElements, name)) return Standing::Drawn;
  return is_among(kSilent, name) || name.find(':') != std::string_view::npos ? Standing::LeftOut
                                                                             : Standing::Refused;
}

Standing standing_of_attribute(std::string_view name) {
  if (is_among(kGeometry, name) || is_presentation(name)) return Standing::Drawn;
  // Written as OnClick it would run nothing in SVG, but in HTML; whoever has written it ought to know.
  return lower_without_space(name).starts_with("on") ? Standing::Refused : Standing::LeftOut;
}

bool is_view_box(std::string_view value) {
  std::string plain(value);
  std::ranges::replace(plain, ',', ' ');
  std::istringstream in(plain);
  in.imbue(std::locale::classic());
  std::array<double, 4> numbers{};  // x, y, width, height
  for (double& number : numbers) in >> number;
  if (!in || !(in >> std::ws).eof()) return false;
  return std::ranges::all_of(numbers, [](double number) { return std::abs(number) <= kFarthest; }) &&
         numbers[2] > 0 && numbers[3] > 0;
}

bool is_presentation(std::string_view property) {
  return is_among(kPresentation, property);
}

bool is_harmless(std::string_view value) {
  const std::string plain = lower_without_space(value);
  if (plain.find('\\') != std::string::npos || plain.find("javascript:") != std::string::npos ||
      plain.find("expression(") != std::string::npos || plain.find("/*") != std::string::npos ||
      plain.find("image(") != std::string::npos || plain.find("image-set(") != std::string::npos)
    return false;
  for (std::size_t at = plain.find("url("); at != std::string::npos; at = plain.find("url(", at + 1)) {
    const std::string_view rest = std::string_view(plain).substr(at + 4);
    const std::size_t quote = rest.starts_with('\'') || rest.starts_with('"') ? 1 : 0;
    if (!rest.substr(quote).starts_with('#')) return false;
  }
  return true;
}

std::optional<std::size_t> unknown_entity(std::string_view text) {
  for (std::size_t at = text.find_first_of("&<"); at < text.size(); at = text.find_first_of("&<", at)) {
    if (text[at] == '<') {
      const std::size_t end = end_of_plain(text, at);
      at = std::max(end, at + 1);
      continue;
    }
    const std::size_t end = text.find_first_of(";<&", at + 1);
    if (end == std::string_view::npos || text[end] != ';') return at;
    if (!is_known_entity(text.substr(at + 1, end - at - 1))) return at;
    at = end;
  }
  return std::nullopt;
}

}  // namespace stepwright::drawing

#include "hmi_web/drawing/vocabulary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

namespace stepwright::drawing {
namespace {

constexpr std::array<std::string_view, 26> kElements = {
    "svg",      "g",     "defs",           "symbol",         "use",   "title",    "desc",
    "path",     "rect",  "circle",         "ellipse",        "line",  "polyline", "polygon",
    "text",     "tspan", "linearGradient", "radialGradient", "stop",  "clipPath", "pattern",
    "textPath", "image", "marker",         "mask",           "switch"};
// A style sheet is taken apart before (style_sheet.h); what a filter would do is missed where it is used.
constexpr std::array<std::string_view, 4> kSilent = {"metadata", "view", "style", "filter"};
constexpr std::array<std::string_view, 7> kShapes = {"path", "rect",    "circle",  "ellipse",
                                                     "line", "polygon", "polyline"};
// That show something without being shapes.
constexpr std::array<std::string_view, 3> kShown = {"text", "image", "use"};

struct Miss {
  std::string_view name;
  const char* what;
  const char* hint;
};
constexpr std::array kMissedElements = {
    Miss{"flowRoot", "text that flows in a frame is not drawn", "Inkscape: Text, Convert to Text"},
    Miss{"font", "fonts of the file are not used", "text is drawn with the fonts of the browser's machine"},
    Miss{"font-face", "fonts of the file are not used",
         "text is drawn with the fonts of the browser's machine"},
    Miss{"mesh", "a gradient mesh is not drawn", "a linear or radial gradient is"},
    Miss{"meshgradient", "a gradient mesh is not drawn", "a linear or radial gradient is"},
    Miss{"hatch", "a hatching is not drawn", "a <pattern> is"},
    Miss{"solidcolor", "a named colour is not used", "give shapes their colour themselves"}};
constexpr std::array kMissedProperties = {
    Miss{"filter", "shadows, blurs and other filters are not drawn", "draw a shadow as a shape of its own"},
    Miss{"backdrop-filter", "shadows, blurs and other filters are not drawn",
         "draw a shadow as a shape of its own"},
    Miss{"mix-blend-mode", "colours lie on each other and are not blended", "use opacity"},
    Miss{"transform", "what a style moves or turns stays where it is drawn", "use the attribute transform"},
    Miss{"animation", "nothing moves by itself", "bind it with data-move or data-turn"},
    Miss{"mask-image", "what it hides is seen", "use a <mask>"}};

constexpr std::array<std::string_view, 44> kGeometry = {"viewBox",
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
                                                        "startOffset",
                                                        "maskUnits",
                                                        "maskContentUnits",
                                                        "role"};
// Those that are one or several lengths.
constexpr std::array<std::string_view, 26> kLengths = {
    "x",      "y",      "x1",          "y1",     "x2",          "y2",           "cx",         "cy",
    "r",      "rx",     "ry",          "fx",     "fy",          "dx",           "dy",         "width",
    "height", "offset", "startOffset", "rotate", "markerWidth", "markerHeight", "textLength", "pathLength",
    "refX",   "refY"};
constexpr std::array<std::string_view, 12> kUnits = {"",   "px", "mm", "cm", "in", "pt",
                                                     "pc", "em", "ex", "%",  "Q",  "rem"};
// In place of a length.
constexpr std::array<std::string_view, 7> kWords = {"auto", "center", "left",   "right",
                                                    "top",  "bottom", "inherit"};
constexpr std::array<std::string_view, 40> kPresentation = {"fill",
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
                                                            "mask",
                                                            "mask-type",
                                                            "marker-start",
                                                            "marker-mid",
                                                            "marker-end",
                                                            "vector-effect",
                                                            "paint-order",
                                                            "shape-rendering",
                                                            "text-rendering"};

// Of a drawing's own units: beyond it a browser computes with what is left of a float.
constexpr double kFarthest = 1e6;
// Of what stands in it, also far outside: the largest number that a browser takes for a length.
constexpr double kLongest = 1e9;

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

template <std::size_t N>
const Miss* miss_of(const std::array<Miss, N>& misses, std::string_view name) {
  const auto found = std::ranges::find(misses, name, &Miss::name);
  return found == misses.end() ? nullptr : &*found;
}

std::optional<Missed> told(const Miss* miss) {
  if (miss == nullptr) return std::nullopt;
  return Missed{miss->what, miss->hint};
}

// "12.5" and what stands behind it; nothing: no number that a browser could draw with.
std::optional<std::string_view> behind_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view digits(text.data(), static_cast<std::size_t>(end - text.data()));
  const bool is_tiny =
      error == std::errc::result_out_of_range && digits.find('-', 1) != std::string_view::npos;
  if ((error != std::errc{} && !is_tiny) || !std::isfinite(number) || std::abs(number) > kLongest)
    return std::nullopt;
  return text.substr(digits.size());
}

bool is_length(std::string_view text) {
  if (is_among(kWords, text)) return true;
  const auto unit = behind_number(text);
  return unit && is_among(kUnits, *unit);
}

// Whether all numbers in "M 0 0 L 5 1e999" are such. What is none of a number is somebody else's.
bool has_plain_numbers(std::string_view text) {
  constexpr std::string_view kBegin = "0123456789.";
  for (std::size_t at = text.find_first_of(kBegin); at != std::string_view::npos;
       at = text.find_first_of(kBegin)) {
    const auto rest = behind_number(text.substr(at));
    if (!rest) return false;
    text = *rest;
  }
  return true;
}

}  // namespace

Standing standing_of_element(std::string_view name) {
  if (is_among(kElements, name)) return Standing::Drawn;
  if (missed_element(name)) return Standing::Missed;
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

std::optional<Missed> missed_element(std::string_view name) {
  return told(miss_of(kMissedElements, name));
}

std::optional<Missed> missed_property(std::string_view property, std::string_view value) {
  if (value == "none" || value == "normal" || value == "pass-through" || value == "passthrough")
    return std::nullopt;
  return told(miss_of(kMissedProperties, property));
}

bool is_seen(std::string_view name) {
  return is_among(kShapes, name) || is_among(kShown, name);
}

bool is_drawable(std::string_view name, std::string_view value) {
  if (value.find('{') != std::string_view::npos) return true;  // of a face: each copy has its own
  // Neither a path nor points have an "n", and nan, infinity and undefined do; nor do they refer to anything.
  if ((name == "d" || name == "points") && value.find_first_of("nN(") != std::string_view::npos) return false;
  if (name == "d" || name == "points" || name == "transform") return has_plain_numbers(value);
  if (!is_among(kLengths, name)) return true;
  constexpr std::string_view kBetween = " ,\t\r\n";
  while (true) {
    value.remove_prefix(std::min(value.find_first_not_of(kBetween), value.size()));
    if (value.empty()) return true;
    const std::size_t end = std::min(value.find_first_of(kBetween), value.size());
    if (!is_length(value.substr(0, end))) return false;
    value.remove_prefix(end);
  }
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

}  // namespace stepwright::drawing

#include "cell/hmi/model_drawing.h"

#include <algorithm>

#include "cell/hmi/drawing_units.h"
#include "plant_models/components/layout.h"
#include "runtime/ground/markup/xml_text.h"

namespace stepwright::hmi {
namespace {

using components::PortKind;
using components::PortSpec;
using components::Role;

constexpr double kLeastWidth = 130.0;
constexpr double kMostWidth = 260.0;
constexpr double kLetter = 8.4;  // of a name, bold
constexpr double kBoxHeight = 76.0;
constexpr double kGap = 60.0;
constexpr double kRow = 104.0;
constexpr double kEdge = 20.0;
constexpr std::size_t kMostLines = 2;         // of values in a box
constexpr std::size_t kMostComponents = 400;  // the page draws no more

const char* sign_of(const std::string& unit) {
  return unit == "percent" ? "%" : unit == "degC" ? "°C" : unit == "degree" ? "°" : unit.c_str();
}

class ModelDrawing {
 public:
  ModelDrawing(const components::Model& model, PicturePoints& points)
      : model_(model), points_(points), layout_(components::lay_out(model)), width_(box_width(model)) {}

  std::string draw() {
    for (const core::Quantity& truth : model_.truths)
      points_.truth(truth.name, truth.name, sign_of(truth.unit), truth.name.ends_with(".level"), truth.name);
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
           units(2.0 * kEdge + layout_.columns * (width_ + kGap)) + " " +
           units(2.0 * kEdge + layout_.rows * kRow) + "\">\n<title>" + markup::xml_escaped(model_.text.name) +
           "</title>\n";
    if (model_.names.size() <= kMostComponents) {
      for (const components::ModelLink& link : model_.links) add_link(link);
      for (std::uint32_t i = 0; i < model_.names.size(); ++i) add_box(i);
    }
    return out_ + "</svg>\n";
  }

 private:
  // So that the longest name stands in its box.
  static double box_width(const components::Model& model) {
    std::size_t longest = 0;
    for (const std::string& name : model.names) longest = std::max(longest, name.size());
    return std::clamp(24.0 + kLetter * static_cast<double>(longest), kLeastWidth, kMostWidth);
  }

  double left(std::uint32_t component) const {
    return kEdge + layout_.placed[component].column * (width_ + kGap);
  }
  double top(std::uint32_t component) const { return kEdge + layout_.placed[component].row * kRow; }

  // The free space between two rows, nearest to the way: a line back takes it underneath.
  static double lane(double y0, double y1, bool forward) {
    if (forward) return y1 < y0 ? y0 - 0.5 * kRow : y0 + 0.5 * kRow;
    return std::max(y0, y1) + 0.5 * kRow;
  }

  // Out of the right of one and into the left of the other; back, and past what stands between, in a lane.
  void add_link(const components::ModelLink& link) {
    const bool wet = link.kind == PortKind::Fluid;
    const double x0 = left(link.from) + width_, y0 = top(link.from) + 0.5 * kBoxHeight;
    const double x1 = left(link.to), y1 = top(link.to) + 0.5 * kBoxHeight;
    const bool next = x1 > x0 && x1 - x0 <= kGap;
    std::string path = "M" + units(x0) + " " + units(y0) + "H" + units(next ? 0.5 * (x0 + x1) : x0 + 20.0);
    if (!next) path += "V" + units(lane(y0, y1, x1 > x0)) + "H" + units(x1 - 20.0);
    path += "V" + units(y1) + "H" + units(x1);
    out_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"var(--" + (wet ? "line-strong" : "line") +
            ")\" stroke-width=\"" + (wet ? "3" : "1") + "\"" + (wet ? "" : " stroke-dasharray=\"4 3\"") +
            "/>\n";
  }

  void add_box(std::uint32_t component) {
    const components::ComponentType& type = *model_.types[component];
    const std::string& name = model_.names[component];
    const double x = left(component), y = top(component);
    const auto shape = "x=\"" + units(x) + "\" y=\"" + units(y) + "\" width=\"" + units(width_) +
                       "\" height=\"" + units(kBoxHeight) + "\"";
    out_ += "<g><title>" + markup::xml_escaped(name + " (" + type.name + ")") + "</title>\n<rect " + shape +
            " fill=\"var(--equipment)\" stroke=\"var(--line-strong)\"/>\n";
    const bool fills = std::any_of(type.ports.begin(), type.ports.end(), [](const PortSpec& one) {
      return one.name == "level" && one.role == Role::Node && one.unit == "percent";
    });
    if (fills)
      out_ += "<rect " + shape + " fill=\"var(--liquid)\" data-fill=\"" + name +
              ".level\" data-from=\"0\" data-to=\"100\"/>\n";
    add_contact(type, name, x, y);
    add_text(x + 8.0, y + 18.0, markup::xml_escaped(name), "font-weight=\"bold\"");
    std::size_t line = 0;
    for (const PortSpec& port : type.ports) {
      if (port.role != Role::Node || port.kind != PortKind::Signal || line == kMostLines) continue;
      const std::string truth = name + "." + port.name;
      add_text(x + 8.0, y + 38.0 + 18.0 * static_cast<double>(line), "",
               "data-text=\"" + truth + "\" data-digits=\"2\" data-unit=\"" + unit_of(truth) + "\"");
      ++line;
    }
    out_ += "</g>\n";
  }

  // Of a component with a contact, its first one: a strip beside the texts, which are read on any colour.
  void add_contact(const components::ComponentType& type, const std::string& name, double x, double y) {
    constexpr double kStrip = 10.0;
    const auto contact = std::ranges::find_if(type.ports, [](const PortSpec& port) {
      return port.role == Role::Node && port.kind == PortKind::Logic;
    });
    if (contact == type.ports.end()) return;
    out_ += "<rect x=\"" + units(x + width_ - kStrip) + "\" y=\"" + units(y) + "\" width=\"" + units(kStrip) +
            "\" height=\"" + units(kBoxHeight) +
            "\" fill=\"var(--equipment)\" stroke=\"var(--line-strong)\" data-on=\"" + name + "." +
            contact->name + "\"/>\n";
  }

  std::string unit_of(const std::string& truth) const {
    for (const core::Quantity& one : model_.truths)
      if (one.name == truth) return markup::xml_escaped(sign_of(one.unit));
    return {};
  }

  void add_text(double x, double y, const std::string& text, const std::string& more) {
    out_ += "<text x=\"" + units(x) + "\" y=\"" + units(y) + "\" font-size=\"13\" fill=\"var(--text)\" " +
            more + ">" + text + "</text>\n";
  }

  const components::Model& model_;
  PicturePoints& points_;
  components::Layout layout_;
  double width_;  // of a box
  std::string out_;
};

}  // namespace

std::string model_drawing(const components::Model& model, PicturePoints& points) {
  return ModelDrawing(model, points).draw();
}

}  // namespace stepwright::hmi

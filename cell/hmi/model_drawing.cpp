#include "cell/hmi/model_drawing.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "cell/hmi/component_symbols.h"
#include "cell/hmi/drawing_units.h"
#include "cell/hmi/link_routes.h"
#include "plant_models/components/layout.h"
#include "runtime/ground/markup/xml_text.h"

namespace stepwright::hmi {
namespace {

using components::PortKind;
using components::PortSpec;
using components::Role;

constexpr double kLeastWidth = 150.0;
constexpr double kMostWidth = 280.0;
constexpr double kLetter = 8.4;  // of a name, bold
constexpr double kInset = 8.0;   // of what stands in a box
constexpr double kHead = 30.0;   // its name and its symbol
constexpr double kLine = 18.0;   // a value
constexpr double kFoot = 8.0;
constexpr double kLamp = 12.0;
constexpr std::size_t kMostValues = 3, kMostSwitches = 2;  // in a box
constexpr std::size_t kMostComponents = 400;               // the page draws no more

const char* sign_of(const std::string& unit) {
  return unit == "percent" ? "%" : unit == "degC" ? "°C" : unit == "degree" ? "°" : unit.c_str();
}

// What a box shows of its component: the first values and switches that it puts out.
struct BoxLines {
  std::vector<const PortSpec*> values, switches;

  double height() const {
    return kHead + kLine * static_cast<double>(values.size() + switches.size()) + kFoot;
  }
};

class ModelDrawing {
 public:
  ModelDrawing(const components::Model& model, PicturePoints& points)
      : model_(model), points_(points), layout_(components::lay_out(model)) {
    BoxSizes sizes;
    sizes.box_width = box_width(model);
    sizes.row_height.assign(layout_.rows, 0.0);
    for (std::uint32_t i = 0; i < model.names.size(); ++i) {
      lines_.push_back(lines_of(i));
      double& height = sizes.row_height[layout_.placed[i].row];
      height = std::max(height, lines_.back().height());
    }
    width_ = sizes.box_width;
    routes_ = route_links(layout_, model.links, sizes);
  }

  std::string draw() {
    for (const core::Quantity& truth : model_.truths)
      points_.truth(truth.name, truth.name, sign_of(truth.unit), truth.name.ends_with(".level"), truth.name);
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + units(routes_.width) + " " +
           units(routes_.whole) + "\">\n<title>" + markup::xml_escaped(model_.text.name) + "</title>\n";
    if (model_.names.size() <= kMostComponents) {
      for (std::size_t i = 0; i < model_.links.size(); ++i) add_link(model_.links[i], routes_.ways[i]);
      for (std::uint32_t i = 0; i < model_.names.size(); ++i) add_box(i);
    }
    return out_ + "</svg>\n";
  }

 private:
  // So that the longest name stands beside the symbol of its box.
  static double box_width(const components::Model& model) {
    std::size_t longest = 0;
    for (const std::string& name : model.names) longest = std::max(longest, name.size());
    return std::clamp(24.0 + kSymbolSize + kLetter * static_cast<double>(longest), kLeastWidth, kMostWidth);
  }

  BoxLines lines_of(std::uint32_t component) const {
    const components::Parameters& parameters = model_.text.components[component].parameters;
    const auto thermal = parameters.words.find("thermal");
    // Its temperature stays as it is.
    const bool cold = thermal != parameters.words.end() && thermal->second == "no";
    BoxLines lines;
    for (const PortSpec& port : model_.types[component]->ports) {
      if (port.role != Role::Node || !parameters.has(port.needs)) continue;
      if (cold && port.name == "temperature_out") continue;
      if (port.kind == PortKind::Signal && lines.values.size() < kMostValues) lines.values.push_back(&port);
      if (port.kind == PortKind::Logic && lines.switches.size() < kMostSwitches)
        lines.switches.push_back(&port);
    }
    return lines;
  }

  // Signals have an arrow where they go to.
  void add_link(const components::ModelLink& link, const std::vector<Corner>& way) {
    const bool wet = link.kind == PortKind::Fluid;
    std::string path = "M" + units(way.front().x) + " " + units(way.front().y);
    for (std::size_t i = 1; i < way.size(); ++i)
      path += way[i].y == way[i - 1].y ? "H" + units(way[i].x) : "V" + units(way[i].y);
    const std::string colour = wet ? "var(--line-strong)" : "var(--line)";
    out_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" +
            (wet ? "3" : "1.2") + "\"" + (wet ? "" : " stroke-dasharray=\"4 3\"") + "/>\n";
    if (wet) return;
    const double x = way.back().x, y = way.back().y;
    out_ += "<polygon points=\"" + units(x) + "," + units(y) + " " + units(x - 7.0) + "," + units(y - 3.5) +
            " " + units(x - 7.0) + "," + units(y + 3.5) + "\" fill=\"" + colour + "\"/>\n";
  }

  void add_box(std::uint32_t component) {
    const components::ComponentType& type = *model_.types[component];
    const std::string& name = model_.names[component];
    const components::Placed& at = layout_.placed[component];
    const double x = routes_.left[at.column], y = routes_.top[at.row];
    const auto shape = "x=\"" + units(x) + "\" y=\"" + units(y) + "\" width=\"" + units(width_) +
                       "\" height=\"" + units(routes_.height[at.row]) + "\"";
    out_ += "<g><title>" + markup::xml_escaped(name + " (" + type.name + ")") + "</title>\n<rect " + shape +
            " fill=\"var(--equipment)\" stroke=\"var(--line-strong)\"/>\n";
    const bool fills = std::any_of(type.ports.begin(), type.ports.end(), [](const PortSpec& one) {
      return one.name == "level" && one.role == Role::Node && one.unit == "percent";
    });
    if (fills)
      out_ += "<rect " + shape + " fill=\"var(--liquid)\" data-fill=\"" + name +
              ".level\" data-from=\"0\" data-to=\"100\"/>\n";
    out_ += component_symbol(type.name, x + width_ - kSymbolSize - 6.0, y + 6.0);
    add_text(x + kInset, y + 19.0, markup::xml_escaped(name), "font-size=\"13\" font-weight=\"bold\"");
    double line = y + kHead + 12.0;
    for (const PortSpec* const port : lines_[component].values) {
      add_value(name + "." + port->name, label_of(*port), x, line);
      line += kLine;
    }
    for (const PortSpec* const port : lines_[component].switches) {
      add_switch(name + "." + port->name, label_of(*port), x, line);
      line += kLine;
    }
    out_ += "</g>\n";
  }

  // As the reference names it, without what tells it from an input.
  static std::string label_of(const PortSpec& port) {
    const std::string_view name = port.name;
    return std::string(name.ends_with("_out") ? name.substr(0, name.size() - 4) : name);
  }

  void add_value(const std::string& truth, const std::string& label, double x, double y) {
    add_text(x + kInset, y, markup::xml_escaped(label), "font-size=\"11\"");
    add_text(x + width_ - kInset, y, "",
             "font-size=\"13\" text-anchor=\"end\" data-text=\"" + truth +
                 "\" data-digits=\"2\" data-unit=\"" + unit_of(truth) + "\"");
  }

  void add_switch(const std::string& truth, const std::string& label, double x, double y) {
    add_text(x + kInset, y, markup::xml_escaped(label), "font-size=\"11\"");
    out_ += "<circle cx=\"" + units(x + width_ - kInset - 0.5 * kLamp) + "\" cy=\"" + units(y - 4.0) +
            "\" r=\"" + units(0.5 * kLamp) +
            "\" fill=\"var(--panel)\" stroke=\"var(--line-strong)\" data-on=\"" + truth + "\"/>\n";
  }

  std::string unit_of(const std::string& truth) const {
    for (const core::Quantity& one : model_.truths)
      if (one.name == truth) return markup::xml_escaped(sign_of(one.unit));
    return {};
  }

  void add_text(double x, double y, const std::string& text, const std::string& more) {
    out_ += "<text x=\"" + units(x) + "\" y=\"" + units(y) + "\" fill=\"var(--text)\" " + more + ">" + text +
            "</text>\n";
  }

  const components::Model& model_;
  PicturePoints& points_;
  components::Layout layout_;
  std::vector<BoxLines> lines_;  // by component
  LinkRoutes routes_;
  double width_ = 0.0;  // of a box
  std::string out_;
};

}  // namespace

std::string model_drawing(const components::Model& model, PicturePoints& points) {
  return ModelDrawing(model, points).draw();
}

}  // namespace stepwright::hmi

#include "ladder/exchange/drawing.h"

#include <utility>

namespace stepwright::exchange {

graphic::Element& Drawing::add(graphic::ElementKind kind, int x, int y, int width, int height) {
  graphic::Element& element = diagram_.elements.emplace_back();
  element.kind = kind;
  element.id = diagram_.elements.size();
  element.position = {static_cast<double>(x), static_cast<double>(y)};
  element.width = width;
  element.height = height;
  return element;
}

graphic::Pin input_from(const std::vector<Source>& sources, std::string name) {
  graphic::Pin pin;
  pin.name = std::move(name);
  for (const Source& source : sources) {
    graphic::Connection& connection = pin.connections.emplace_back();
    connection.from = source.id;
    connection.output = source.output;
  }
  return pin;
}

graphic::Pin output_pin(std::string name) {
  graphic::Pin pin;
  pin.name = std::move(name);
  return pin;
}

graphic::SourceText plain_text(std::string text) {
  return {std::move(text), {}};
}

}  // namespace stepwright::exchange

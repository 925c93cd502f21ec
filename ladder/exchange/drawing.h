#pragma once

// Makes a diagram element by element. Internal to this folder.
//
//   Drawing drawing(graphic::DiagramLanguage::Ladder);
//   const std::uint64_t rail = drawing.add(ElementKind::LeftPowerRail, 20, 20, 3, 40).id;

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/diagram.h"

namespace stepwright::exchange {

// Where a connection comes from: an element and, if it has several outputs, the name of one.
struct Source {
  std::uint64_t id = 0;
  std::string output;
};

class Drawing {
 public:
  explicit Drawing(graphic::DiagramLanguage language) { diagram_.language = language; }

  // A new element, numbered from 1. The reference lasts until the next one is added.
  graphic::Element& add(graphic::ElementKind kind, int x, int y, int width, int height);
  graphic::Element& at(std::uint64_t id) { return diagram_.elements[id - 1]; }
  std::uint64_t last_id() const { return diagram_.elements.size(); }

  graphic::Diagram take() { return std::move(diagram_); }

 private:
  graphic::Diagram diagram_;
};

// Several sources are a wired OR.
graphic::Pin input_from(const std::vector<Source>& sources, std::string name = {});
graphic::Pin output_pin(std::string name = {});
// A text that was never in a file.
graphic::SourceText plain_text(std::string text);

}  // namespace stepwright::exchange

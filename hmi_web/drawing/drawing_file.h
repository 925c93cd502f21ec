#pragma once

// A drawing of the plant that somebody has made, as SVG, in place of the generated one; its elements are
// bound to values by attributes (hmi_web/doc/drawings.md).
//
//   auto drawing = load_drawing("hall.svg");
//   if (!drawing) tell(drawing.error());            // every mistake at once, with its line
//   send(drawing->svg);
//
// Invariant: the result holds only shapes, text, gradients and bindings from lists of known names, with ids
// of their own: no script, no style sheet, no outside address. Pictures stand in the file itself. Data of
// drawing programs (other namespaces, metadata, classes) are left out; what would be missed is told by
// warnings; what could do harm is refused.
//
// What is read again is the same: `read_drawing(name, drawing->svg)->svg == drawing->svg`.
//
// Codes: C0640 the file cannot be read as a drawing, C0641 an element that is not drawn, C0642 an attribute
// that is refused, C0643 a binding that is wrong, C0644 too much of something. Warnings: C0643 an attribute
// `data-...` of somebody else's, C0646 what is left out and is missed, C0647 an
// operator part of the editor that is not filled in.
//
// Pure but for the file; any thread.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/drawing/part.h"
#include "runtime/ground/result/result.h"

namespace stepwright::drawing {

inline constexpr std::size_t kLargestFile = std::size_t{2} << 20;
inline constexpr std::size_t kMostElements = 20'000;
inline constexpr std::size_t kMostBindings = 2'000;
inline constexpr int kDeepest = 64;

// A value that an element is bound to.
struct BoundName {
  std::string name;  // of a variable of the program or of a point of the plant
  result::Location where;
  // Of a name with a brace, in a copy of a face: what the editor keeps of the copy, an object of JSON with
  // `face`, `key` and the fields. Written by whoever has drawn it.
  std::string copy = {};
};

struct Drawing {
  std::string svg;  // one element `svg` with a viewBox
  std::size_t bindings = 0;
  std::vector<BoundName> names = {};  // of the bindings
  std::vector<Part> parts = {};       // that people act with; each that writes has a key of its own
  std::string least = "viewer";       // the role from which it is shown: viewer, operator or engineer
  bool is_symbol = false;             // a face for others to repeat, no screen
  result::Diagnostics warnings =
      {};  // C0643, C0646, C0647: what shows or does otherwise than it stands there
};

[[nodiscard]] result::Result<Drawing> load_drawing(const std::filesystem::path& file);
// `name` stands in the diagnostics.
[[nodiscard]] result::Result<Drawing> read_drawing(const std::string& name, std::string_view text);

}  // namespace stepwright::drawing

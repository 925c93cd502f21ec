#pragma once

// Vocabulary of a drawing: the names of SVG that draw, and nothing that runs or loads from elsewhere.
//
// Pure; any thread.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::drawing {

enum class Standing : unsigned char {
  Drawn,
  LeftOut,  // nobody sees a difference
  Missed,   // left out, and the drawing looks otherwise
  Refused,
};

// What somebody misses in the drawing, and what to do about it.
struct Missed {
  const char* what;
  const char* hint;
};

// `name` without a prefix of the SVG namespace.
Standing standing_of_element(std::string_view name);
// Attributes that begin with `data-`, `style`, `id` and references have rules of their own. What begins with
// "on" is refused, however it is written.
Standing standing_of_attribute(std::string_view name);
std::optional<Missed> missed_element(std::string_view name);
// Of a property of a style, or an attribute, that is left out. Nothing: nobody sees a difference.
std::optional<Missed> missed_property(std::string_view property, std::string_view value);
// An element that shows something by itself.
bool is_seen(std::string_view name);
// False: a length that is none ("1e999", "nan", "12 apples"), or a path with an endless number.
bool is_drawable(std::string_view name, std::string_view value);
// One that may stand in `style="..."` and as an attribute.
bool is_presentation(std::string_view property);
// Four plain numbers, the last two (width and height) above 0; none is NaN, endless or beyond a million.
bool is_view_box(std::string_view value);
// No address of anything outside of the drawing and nothing that is more than a value.
bool is_harmless(std::string_view value);

}  // namespace stepwright::drawing

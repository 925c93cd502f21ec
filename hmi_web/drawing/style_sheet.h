#pragma once

// Style sheets of a drawing (<style>), as drawing programs write them: rules for classes, elements and ids.
// What they say of an element goes into its own style attribute, where it is judged as everything there
// (CSS 2, 6.4.3: the more special rule wins, then the later one, and what stands at the element before all).
//
//   const StyleNews news = apply_styles(root);      // root has no classes to look up any more
//
// Pure; any thread. The work is bounded, whatever the sheets say.

#include <cstddef>
#include <string>
#include <vector>

#include <pugixml.hpp>

namespace stepwright::drawing {

inline constexpr std::size_t kMostSelectors = 5'000;
inline constexpr std::size_t kMostStyleBytes = std::size_t{4} << 20;  // added to all elements
inline constexpr std::size_t kMostStyleLooks = 4'000'000;             // of a selector at an element

struct StyleRemark {
  std::ptrdiff_t offset = 0;  // of the <style> in the file
  std::string what;           // the selector or the at-rule
};

struct StyleNews {
  std::vector<StyleRemark> left_out;  // selectors and at-rules that nothing here can follow
  std::vector<StyleRemark> loading;   // @import
  bool excess = false;                // more than the bounds above; what was to come is not applied
};

StyleNews apply_styles(pugi::xml_node root);

}  // namespace stepwright::drawing

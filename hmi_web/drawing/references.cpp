#include "hmi_web/drawing/references.h"

#include <algorithm>
#include <map>
#include <vector>

#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::drawing {
namespace {

constexpr std::string_view kSvgPrefix = "svg:";
// Of references within what is referred to; nobody draws that deep, and a stack has an end.
constexpr int kDeepestReference = 16;
// Elements around one another, also in what is left out of a drawing, and by each reference once more.
constexpr int kDeepestWalk = kDeepest * (kDeepestReference + 1);

bool is_use(pugi::xml_node node) {
  return plain_name(node.name()) == "use";
}

// Of a path's or a polyline's markers: one for each vertex, of which no number is longer than its text.
std::size_t most_vertices(pugi::xml_node node) {
  const std::string_view text =
      node.attribute("d") ? node.attribute("d").value() : node.attribute("points").value();
  return 2 + text.size() / 2;
}

class References {
 public:
  explicit References(pugi::xml_node root) {
    for (const auto& each : root.select_nodes("//*[@id]"))
      by_id_.emplace(each.node().attribute("id").value(), each.node());
  }

  // How many elements are drawn by the references below `node`, and where that is too much.
  void look_at(pugi::xml_node node) { drawn_by_references_below(node, 0); }
  const std::optional<ReferenceExcess>& excess() const { return excess_; }

 private:
  void tell(pugi::xml_node node, std::string message, std::string hint) {
    if (!excess_) excess_ = {node.offset_debug(), std::move(message), std::move(hint)};
  }

  std::size_t drawn_by_references_below(pugi::xml_node node, int depth) {
    if (nested_ >= kDeepestWalk) {
      tell(node, "elements are nested more than " + std::to_string(kDeepest) + " deep",
           "ungroup some of them");
      return 0;
    }
    ++nested_;
    const std::size_t drawn = drawn_by_node(node, depth);
    --nested_;
    return drawn;
  }

  std::size_t drawn_by_node(pugi::xml_node node, int depth) {
    std::size_t drawn = 0;
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const std::string_view name = attribute.name();
      if (name == "style")
        drawn += drawn_by_style(node, attribute.value(), depth);
      else if (name != "href" && name != "xlink:href")
        drawn += drawn_by_value(node, name, attribute.value(), depth);
    }
    if (const std::string_view target = reference_of(node); target.starts_with('#'))
      drawn += drawn_by(node, target.substr(1), depth);
    for (const pugi::xml_node child : node.children()) {
      if (excess_) return 0;
      if (child.type() == pugi::node_element) drawn += drawn_by_references_below(child, depth);
    }
    if (drawn > kMostElements)
      tell(node,
           "all <use>, patterns, clips and markers together draw more than " + std::to_string(kMostElements) +
               " elements",
           "refer to fewer or simpler shapes");
    return drawn;
  }

  std::size_t drawn_by_style(pugi::xml_node node, std::string_view style, int depth) {
    std::size_t drawn = 0;
    while (!style.empty()) {
      const std::size_t end = std::min(style.find(';'), style.size());
      const std::string_view declaration = style.substr(0, end);
      style.remove_prefix(std::min(end + 1, style.size()));
      drawn += drawn_by_value(node, declaration, declaration, depth);
    }
    return drawn;
  }

  // Markers stand at every vertex.
  std::size_t drawn_by_value(pugi::xml_node node, std::string_view property, std::string_view value,
                             int depth) {
    const std::size_t count = property.substr(0, property.find(':')).find("marker") != std::string_view::npos
                                  ? most_vertices(node)
                                  : 1;
    std::size_t drawn = 0;
    for (const std::string_view id : ids_in(value)) drawn += times(drawn_by(node, id, depth), count);
    return drawn;
  }

  // What one reference draws: what it refers to, with what that refers to.
  std::size_t drawn_by(pugi::xml_node from, std::string_view id, int depth) {
    const auto found = by_id_.find(id);
    if (found == by_id_.end() || excess_) return 0;
    const pugi::xml_node target = found->second;
    if (is_use(from) && target.select_node("descendant-or-self::*[local-name()='use']")) {
      tell(from, "this <use> refers to something that holds a <use> itself", "refer to the shapes");
      return 0;
    }
    if (const auto known = known_.find(target); known != known_.end()) return known->second;
    if (depth >= kDeepestReference || std::find(open_.begin(), open_.end(), target) != open_.end()) {
      tell(from,
           "this <" + std::string(plain_name(from.name())) +
               "> refers to something that leads back to it, or on and on",
           "refer to the shapes");
      return 0;
    }
    open_.push_back(target);
    const std::size_t drawn =
        target.select_nodes("descendant-or-self::*").size() + drawn_by_references_below(target, depth + 1);
    open_.pop_back();
    known_.emplace(target, drawn);
    return drawn;
  }

  // Enough to be too much is enough: numbers do not run over.
  static std::size_t times(std::size_t drawn, std::size_t count) {
    return std::min(drawn, kMostElements + 1) * std::min(count, kMostElements + 1);
  }

  static std::vector<std::string_view> ids_in(std::string_view value) {
    std::vector<std::string_view> ids;
    for (std::size_t at = value.find("url("); at != std::string_view::npos; at = value.find("url(", at + 1)) {
      const std::size_t hash = value.find('#', at);
      if (hash == std::string_view::npos) break;
      ids.push_back(value.substr(hash + 1, value.find_first_of("'\") ", hash) - hash - 1));
    }
    return ids;
  }

  std::map<std::string, pugi::xml_node, std::less<>> by_id_;
  std::map<pugi::xml_node, std::size_t> known_;
  std::vector<pugi::xml_node> open_;  // that are being looked at
  int nested_ = 0;                    // elements around what is looked at, also by references
  std::optional<ReferenceExcess> excess_;
};

}  // namespace

std::string_view plain_name(std::string_view name) {
  return name.starts_with(kSvgPrefix) ? name.substr(kSvgPrefix.size()) : name;
}

std::string_view reference_of(pugi::xml_node element) {
  const pugi::xml_attribute own = element.attribute("href");
  return own ? own.value() : element.attribute("xlink:href").value();
}

std::optional<ReferenceExcess> excess_of_references(pugi::xml_node root) {
  References references(root);
  references.look_at(root);
  return references.excess();
}

}  // namespace stepwright::drawing

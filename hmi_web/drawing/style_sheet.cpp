#include "hmi_web/drawing/style_sheet.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "hmi_web/drawing/references.h"
#include "hmi_web/drawing/trimmed.h"

namespace stepwright::drawing {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f";

// One element by all that it is: "path.cls-1.thin", "#valve", "*".
struct Selector {
  std::string element = {};  // empty: any
  std::string id = {};
  std::vector<std::string> classes = {};
  std::size_t body = 0;   // its declarations
  std::size_t order = 0;  // in the sheets

  std::tuple<bool, std::size_t, bool, std::size_t> rank() const {
    return {!id.empty(), classes.size(), !element.empty(), order};
  }
};

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// False: it is more than this.
bool read_selector(std::string_view text, Selector& selector) {
  while (!text.empty()) {
    const char sign = text.front();
    if (sign == '.' || sign == '#' || sign == '*') text.remove_prefix(1);
    if (sign == '*') continue;
    std::size_t length = 0;
    while (length < text.size() && is_name(text[length])) ++length;
    if (length == 0) return false;
    std::string name(text.substr(0, length));
    text.remove_prefix(length);
    if (sign == '.')
      selector.classes.push_back(std::move(name));
    else
      (sign == '#' ? selector.id : selector.element) = std::move(name);
  }
  return true;
}

std::string without_comments(std::string_view text) {
  std::string plain;
  for (std::size_t at = text.find("/*"); at != std::string_view::npos; at = text.find("/*")) {
    plain.append(text.substr(0, at)).append(1, ' ');
    const std::size_t end = text.find("*/", at + 2);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
  }
  return plain.append(text);
}

std::vector<std::string_view> classes_of(pugi::xml_node element) {
  std::vector<std::string_view> classes;
  std::string_view text = element.attribute("class").value();
  while (!(text = trimmed(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    classes.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return classes;
}

class Sheets {
 public:
  explicit Sheets(StyleNews& news) : news_(news) {}

  void read(pugi::xml_node style) {
    offset_ = style.offset_debug();
    std::string text;
    for (const pugi::xml_node child : style.children()) text += child.value();
    const std::string plain = without_comments(text);
    std::string_view rest = trimmed(plain);
    while (!rest.empty() && !news_.excess)
      rest = trimmed(rest.front() == '@' ? after_at_rule(rest) : after_rule(rest));
  }

  void apply(pugi::xml_node element) {
    if (selectors_.empty() || news_.excess) return;
    const auto classes = classes_of(element);
    std::vector<const Selector*> found;
    collect("#" + std::string(element.attribute("id").value()), element, classes, found);
    for (const std::string_view each : classes) collect("." + std::string(each), element, classes, found);
    collect(std::string(plain_name(element.name())), element, classes, found);
    collect("*", element, classes, found);
    if (found.empty()) return;
    std::ranges::sort(found, {}, [](const Selector* each) { return each->rank(); });
    const auto same = std::ranges::unique(found);
    found.erase(same.begin(), same.end());
    std::string style;
    for (const Selector* each : found) style += bodies_[each->body] + ";";
    bytes_ += style.size();
    news_.excess = news_.excess || bytes_ > kMostStyleBytes;
    if (news_.excess) return;
    pugi::xml_attribute own = element.attribute("style");
    if (!own) own = element.append_attribute("style");
    own = (style + own.value()).c_str();
  }

 private:
  void leave_out(std::string_view what) {
    news_.left_out.push_back({offset_, std::string(trimmed(what).substr(0, 60))});
  }

  std::string_view after_rule(std::string_view text) {
    const std::size_t begin = text.find('{');
    if (begin == std::string_view::npos) return leave_out(text), std::string_view();
    const std::size_t end = std::min(text.find('}', begin), text.size());
    bodies_.emplace_back(trimmed(text.substr(begin + 1, end - begin - 1)));
    std::string_view selectors = text.substr(0, begin);
    while (!selectors.empty()) {
      const std::size_t comma = std::min(selectors.find(','), selectors.size());
      keep(trimmed(selectors.substr(0, comma)));
      selectors.remove_prefix(std::min(comma + 1, selectors.size()));
    }
    return text.substr(std::min(end + 1, text.size()));
  }

  // "@media print { .a { fill: red } }", "@import url(x);".
  std::string_view after_at_rule(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_of("{;"), text.size());
    const std::string_view head = text.substr(0, begin);
    if (head.starts_with("@import"))
      news_.loading.push_back({offset_, std::string(head.substr(0, 60))});
    else if (!head.starts_with("@charset") && !head.starts_with("@namespace"))
      leave_out(head);
    std::size_t at = begin;
    for (int open = 0; at < text.size(); ++at) {
      if (text[at] == '{') ++open;
      if (text[at] == '}') --open;
      if (open <= 0 && (text[at] == '}' || text[at] == ';')) break;
    }
    return text.substr(std::min(at + 1, text.size()));
  }

  void keep(std::string_view text) {
    if (++order_ > kMostSelectors) {
      news_.excess = true;
      return;
    }
    Selector selector{.body = bodies_.size() - 1, .order = order_};
    if (text.empty() || !read_selector(text, selector)) return leave_out(text);
    const std::string key = !selector.id.empty()        ? "#" + selector.id
                            : !selector.classes.empty() ? "." + selector.classes.front()
                            : !selector.element.empty() ? selector.element
                                                        : "*";
    selectors_[key].push_back(std::move(selector));
  }

  void collect(const std::string& key, pugi::xml_node element, const std::vector<std::string_view>& classes,
               std::vector<const Selector*>& found) {
    const auto there = selectors_.find(key);
    ++looks_;
    if (there == selectors_.end()) return;
    for (const Selector& each : there->second) {
      looks_ += 1 + each.classes.size() * classes.size();
      if (looks_ > kMostStyleLooks) news_.excess = true;
      if (news_.excess) return;
      const bool fits = (each.element.empty() || each.element == plain_name(element.name())) &&
                        (each.id.empty() || each.id == element.attribute("id").value()) &&
                        std::ranges::all_of(each.classes, [&](const std::string& name) {
                          return std::ranges::find(classes, name) != classes.end();
                        });
      if (fits) found.push_back(&each);
    }
  }

  StyleNews& news_;
  std::ptrdiff_t offset_ = 0;
  std::size_t order_ = 0;
  std::size_t looks_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::string> bodies_;
  std::map<std::string, std::vector<Selector>> selectors_;  // by what a fitting element has at least
};

// The library's own walk: it needs no stack, however deep the elements are nested.
template <typename Use>
class Walk : public pugi::xml_tree_walker {
 public:
  explicit Walk(Use use) : use_(std::move(use)) {}
  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_element) use_(node);
    return true;
  }

 private:
  Use use_;
};

}  // namespace

StyleNews apply_styles(pugi::xml_node root) {
  StyleNews news;
  Sheets sheets(news);
  Walk reading([&](pugi::xml_node node) {
    if (plain_name(node.name()) == "style") sheets.read(node);
  });
  root.traverse(reading);
  sheets.apply(root);
  Walk applying([&](pugi::xml_node node) { sheets.apply(node); });
  root.traverse(applying);
  return news;
}

}  // namespace stepwright::drawing

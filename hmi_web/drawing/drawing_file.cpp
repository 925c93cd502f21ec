#include "hmi_web/drawing/drawing_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "hmi_web/drawing/bindings.h"
#include "hmi_web/drawing/characters.h"
#include "hmi_web/drawing/parts.h"
#include "hmi_web/drawing/pictures.h"
#include "hmi_web/drawing/references.h"
#include "hmi_web/drawing/style_sheet.h"
#include "hmi_web/drawing/trimmed.h"
#include "hmi_web/drawing/vocabulary.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::drawing {
namespace {

constexpr unsigned kParse = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol |
                            pugi::parse_wconv_attribute | pugi::parse_ws_pcdata | pugi::parse_doctype;
// Ids are the drawing's own, and none of the page.
constexpr const char* kPrefix = "drawing-";
constexpr std::size_t kPrefixLength = 8;
constexpr std::size_t kMostMistakes = 50;

// Once: what is read again has them already.
std::string own_id(std::string_view id) {
  return (id.starts_with(kPrefix) ? "" : kPrefix) + std::string(id);
}

// "url(#a)" and "url('#a')" as the drawing's own.
std::string with_own_ids(std::string value) {
  for (std::size_t at = value.find("url("); at != std::string::npos; at = value.find("url(", at + 1)) {
    const std::size_t hash = value.find('#', at);
    if (hash != std::string::npos && value.compare(hash + 1, kPrefixLength, kPrefix) != 0)
      value.insert(hash + 1, kPrefix);
  }
  return value;
}

// "#FFF !important" as "#FFF": nothing here says otherwise.
std::string_view without_importance(std::string_view value) {
  constexpr std::string_view kMark = "important";
  if (!value.ends_with(kMark)) return value;
  const std::string_view before = trimmed(value.substr(0, value.size() - kMark.size()));
  return before.ends_with('!') ? trimmed(before.substr(0, before.size() - 1)) : value;
}

std::string copy_around(pugi::xml_node element) {
  for (; element; element = element.parent()) {
    if (element.attribute("data-symbol").value() == std::string_view("face"))
      return element.attribute("data-params").value();
  }
  return {};
}

class Reader {
 public:
  Reader(const std::string& name, std::string_view text) : name_(name), text_(text) {}

  result::Result<Drawing> read() {
    if (const auto broken = result::place_of_no_utf8(name_, text_))
      return result::fail("C0640", *broken, "this is no UTF-8", result::kUtf8Hint);
    if (const auto at = place_of_control(text_)) {
      tell_no_character(*at);
      return tl::unexpected(mistakes_);
    }
    const pugi::xml_parse_result parsed =
        in_.load_buffer(text_.data(), text_.size(), kParse, pugi::encoding_utf8);
    if (!parsed) {
      tell("C0640", parsed.offset, std::string("this is no well-formed XML: ") + parsed.description(),
           "is the file complete, and every element closed?");
      return tl::unexpected(mistakes_);
    }
    refuse_entities();
    const pugi::xml_node root = in_.document_element();
    if (plain_name(root.name()) != "svg") {
      tell("C0640", root.offset_debug(),
           "the file holds <" + std::string(root.name()).substr(0, 40) + "> and not <svg>",
           "a drawing is an SVG file");
      return tl::unexpected(mistakes_);
    }
    style(root);
    pugi::xml_node drawn = out_.append_child("svg");
    drawn.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
    copy(root, drawn, 1);
    if (!seen_)
      miss("C0646", "nothing", root.offset_debug(), "nothing is drawn in it",
           "is this the file that was meant? A drawing has shapes, text or pictures");
    give_view_box(root, drawn);
    // What is nested too deep is told already, and whoever follows references goes as deep.
    if (auto excess = mistakes_.empty() ? excess_of_references(root) : std::nullopt)
      tell("C0644", excess->offset, std::move(excess->message), std::move(excess->hint));
    if (!mistakes_.empty()) return tl::unexpected(mistakes_);
    std::ostringstream text;
    out_.print(text, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    // What is kept is read again.
    if (text.view().size() > kLargestFile)
      return result::fail("C0640", {name_, 0, 0}, "the drawing as it is kept is larger than 2 MiB",
                          "give many shapes one style by a group around them, and leave out pictures");
    place_names();
    const std::string_view least = root.attribute("data-least").as_string("viewer");
    const bool is_symbol = root.attribute("data-kind").value() == std::string_view("symbol");
    return Drawing{std::move(text).str(), names_.size(), std::move(names_), std::move(parts_),
                   std::string(least),    is_symbol,     warnings()};
  }

 private:
  void tell(const char* code, std::ptrdiff_t offset, std::string message, std::string hint) {
    if (mistakes_.size() >= kMostMistakes) return;
    mistakes_.push_back(
        {code, result::Severity::Error, place_of(offset), std::move(message), std::move(hint)});
  }

  // What is left out and is missed: once for each `what`, at its first place.
  void miss(const char* code, const std::string& what, std::ptrdiff_t offset, std::string message,
            std::string hint) {
    if (const auto at = missed_.find(what); at != missed_.end())
      ++at->second.count;
    else if (missed_.size() < kMostMistakes)
      missed_.emplace(what, Remark{code, offset, std::move(message), std::move(hint)});
  }

  // In the order of the file.
  result::Diagnostics warnings() const {
    std::vector<const Remark*> remarks;
    for (const auto& [what, remark] : missed_) remarks.push_back(&remark);
    std::ranges::stable_sort(remarks, {}, &Remark::offset);
    result::Diagnostics all;
    for (const Remark* each : remarks)
      all.push_back({each->code, result::Severity::Warning, place_of(each->offset),
                     each->message + (each->count > 1 ? " (" + std::to_string(each->count) + " times)" : ""),
                     each->hint});
    return all;
  }

  // Rules of style sheets become styles of the elements.
  void style(pugi::xml_node root) {
    const StyleNews news = apply_styles(root);
    for (const auto& [offset, what] : news.loading)
      tell("C0642", offset, "the style sheet loads another one: " + what, "put its rules into the drawing");
    for (const auto& [offset, what] : news.left_out)
      miss("C0646", "rule " + what, offset, "the style sheet's rule '" + what + "' is left out",
           "rules for classes, ids and elements are followed, such as .pipe, #valve, path.thin");
    if (news.excess)
      tell("C0644", root.offset_debug(), "the style sheets have too many rules, or rules for too much",
           "give shapes their style as attributes: drawing programs offer it when they save");
  }

  // In one go: elements come in the order of the file.
  void place_names() {
    std::size_t at = 0;
    std::size_t start = 0;  // of the line
    std::uint32_t line = 1;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto offset =
          std::clamp<std::ptrdiff_t>(offsets_[i], 0, static_cast<std::ptrdiff_t>(text_.size()));
      for (; at < static_cast<std::size_t>(offset); ++at) {
        if (text_[at] != '\n') continue;
        ++line;
        start = at + 1;
      }
      names_[i].where = {name_, line, static_cast<std::uint32_t>(at - start) + 1};
    }
  }

  result::Location place_of(std::ptrdiff_t offset) const {
    const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    const std::string_view before = text_.substr(0, static_cast<std::size_t>(end));
    const auto line = static_cast<std::uint32_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    return {name_, line, static_cast<std::uint32_t>(before.size() - start) + 1};
  }

  // The parser reads none that the file declares, and leaves those that nobody declares as they stand.
  void refuse_entities() {
    for (const pugi::xml_node child : in_.children()) {
      if (child.type() != pugi::node_doctype ||
          std::string_view(child.value()).find('[') == std::string_view::npos)
        continue;
      return tell("C0641", child.offset_debug(), "a DOCTYPE with declarations of its own is refused",
                  "drawing programs leave it out when they save a plain SVG");
    }
    if (const auto at = place_of_unknown_entity(text_)) tell_no_character(*at);
  }

  void tell_no_character(std::size_t at) {
    tell("C0640", static_cast<std::ptrdiff_t>(at),
         "this is no character that XML knows: " + text_of_no_character(text_, at),
         "&amp; &lt; &gt; &quot; &apos; or a number such as &#176;");
  }

  void copy(pugi::xml_node from, pugi::xml_node to, int depth) {
    if (++elements_ == kMostElements + 1)
      tell("C0644", from.offset_debug(),
           "the drawing has more than " + std::to_string(kMostElements) + " elements",
           "join paths, or leave out what is too small to be seen");
    if (depth == kDeepest + 1)
      tell("C0644", from.offset_debug(),
           "elements are nested more than " + std::to_string(kDeepest) + " deep", "ungroup some of them");
    if (elements_ > kMostElements || depth > kDeepest) return;
    copy_attributes(from, to);
    std::vector<BindingMistake> wrong;
    auto names = check_bindings(from, wrong);
    if (auto part = read_part(from, names, wrong)) take(std::move(*part), from, wrong);
    if (auto idle = idle_symbol(from))
      miss("C0647", "idle " + std::to_string(from.offset_debug()), from.offset_debug(),
           std::move(idle->message), std::move(idle->hint));
    for (std::string& name : names) {
      std::string copy = name.find('{') == std::string::npos ? std::string() : copy_around(from);
      names_.push_back({std::move(name), {}, std::move(copy)});
      offsets_.push_back(from.offset_debug());
    }
    for (auto& [message, hint] : wrong)
      tell("C0643", from.offset_debug(), std::move(message), std::move(hint));
    if (names_.size() > kMostBindings && names_.size() - kMostBindings <= 2)
      tell("C0644", from.offset_debug(),
           "the drawing has more than " + std::to_string(kMostBindings) + " bindings",
           "divide it between several cells");
    const std::string_view name = plain_name(from.name());
    seen_ = seen_ || is_seen(name) || from.attribute("data-part");
    if (name == "switch") return copy_choice(from, to, depth);
    for (const pugi::xml_node child : from.children()) {
      if (child.type() == pugi::node_element)
        copy_element(child, to, depth);
      else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        to.append_child(pugi::node_pcdata).set_value(with_line_ends(child.value()).c_str());
    }
  }

  // Of a <switch> a program draws the first that it can: here never HTML, and what is for everybody before
  // what is for one language.
  void copy_choice(pugi::xml_node from, pugi::xml_node to, int depth) {
    pugi::xml_node chosen;
    bool is_html = false;
    for (const pugi::xml_node child : from.children()) {
      const std::string_view name = plain_name(child.name());
      const bool is_wanted = !child.attribute("requiredExtensions");
      is_html = is_html || (!chosen && is_wanted && name == "foreignObject");
      if (name == "script") copy_element(child, to, depth);  // refused
      if (child.type() != pugi::node_element || standing_of_element(name) != Standing::Drawn || !is_wanted)
        continue;
      const bool is_better =
          chosen && chosen.attribute("systemLanguage") && !child.attribute("systemLanguage");
      if (!chosen || is_better) chosen = child;
    }
    if (is_html)
      miss("C0646", "html", from.offset_debug(),
           chosen ? "formatted text (HTML) is left out: the plain text beside it is drawn"
                  : "formatted text (HTML) is left out, and no plain text stands beside it",
           "draw.io: switch off 'Formatted Text' and 'Word Wrap' of the labels before the export");
    if (chosen) copy_element(chosen, to, depth);
  }

  void take(Part part, pugi::xml_node from, std::vector<BindingMistake>& wrong) {
    if (!part.key.empty() && !keys_.insert(part.key).second)
      wrong.push_back({"two parts have the data-key " + part.key, "each has a name of its own"});
    part.where = place_of(from.offset_debug());
    parts_.push_back(std::move(part));
  }

  void copy_element(pugi::xml_node child, pugi::xml_node to, int depth) {
    const std::string name(plain_name(child.name()));
    switch (standing_of_element(name)) {
      case Standing::Drawn:
        return copy(child, to.append_child(name == "switch" ? "g" : name.c_str()), depth + 1);
      case Standing::LeftOut:
        return;
      case Standing::Missed: {
        const Missed missed = *missed_element(name);
        return miss("C0646", name, child.offset_debug(), "<" + name + "> is left out: " + missed.what,
                    missed.hint);
      }
      case Standing::Refused:
        break;
    }
    const char* hint = "only shapes, text and gradients are drawn";
    if (name == "foreignObject") hint = "HTML is not shown; draw with shapes and text";
    tell("C0641", child.offset_debug(), "the element <" + name.substr(0, 40) + "> is refused", hint);
  }

  void copy_attributes(pugi::xml_node from, pugi::xml_node to) {
    for (const pugi::xml_attribute attribute : from.attributes()) {
      const std::string_view name = attribute.name();
      const std::string value = attribute.value();
      if (name == "id") {
        set(to, "id", own_id(value));
      } else if (name == "href" || name == "xlink:href") {
        if (plain_name(from.name()) == "image") {
          copy_picture(from, name, value, to);
          continue;
        }
        if (!value.starts_with('#'))
          refuse(from, name, value, "only parts of the drawing itself can be referred to: \"#id\"");
        const std::string_view target =
            reference_of(from);  // of an element that has both: the one that counts
        set(to, "href", "#" + own_id(target.substr(std::min<std::size_t>(1, target.size()))));
      } else if (name.starts_with("data-")) {
        copy_data(from, name, value, to);
      } else if (name == "viewBox" && !is_view_box(value)) {
        tell("C0640", from.offset_debug(), "viewBox=\"" + value.substr(0, 60) + "\" says no place and size",
             "four numbers, the width and the height above 0: viewBox=\"0 0 800 400\"");
      } else if (standing_of_attribute(name) == Standing::Drawn) {
        copy_drawn(from, name, value, to);
      } else if (standing_of_attribute(name) == Standing::Refused) {
        refuse(from, name, value, "a drawing runs nothing; bind it with data-on, data-text and so on");
      } else if (name != "style" && name.find(':') == std::string_view::npos) {  // of a drawing program
        refuse_harmful(from, name, value);
      }
    }
    copy_style(from, from.attribute("style").value(), to);
  }

  // Other programs have such attributes, too: the names of layers are the most usual ones.
  void copy_data(pugi::xml_node from, std::string_view name, const std::string& value, pugi::xml_node to) {
    if (is_known_data(name)) return set(to, name, value);
    if (name == "data-name" || name == "data-cell-id") return;
    const bool is_told = missed_.contains(std::string(name)) || missed_.size() >= kMostMistakes;
    const std::string meant = is_told ? std::string() : nearest_data(name);
    miss("C0643", std::string(name), from.offset_debug(),
         "there is no binding " + std::string(name.substr(0, 60)) + ": it is left out",
         meant.empty() ? "data-text, data-on, data-warn, data-alarm, data-show, data-fill, data-move, "
                         "data-turn, data-pose-x"
                       : "did you mean " + meant + "?");
  }

  void copy_drawn(pugi::xml_node from, std::string_view name, const std::string& value, pugi::xml_node to) {
    if (is_drawable(name, value) || !is_harmless(value)) return copy_value(from, name, value, to);
    const std::string element(plain_name(from.name()));
    miss("C0646", element + " " + std::string(name), from.offset_debug(),
         std::string(name) + "=\"" + value.substr(0, 60) + "\" of <" + element +
             "> has a number that cannot be drawn: it is left out",
         "plain numbers, such as 12.5 or 3mm");
  }

  void copy_picture(pugi::xml_node from, std::string_view name, const std::string& value, pugi::xml_node to) {
    if (is_embedded_picture(value)) {
      if (!is_whole_picture(value))
        miss("C0646", "picture", from.offset_debug(),
             "the data of a picture is none: a browser shows it as broken",
             "png, jpeg or webp, whole and in base64");
      return set(to, "href", value);
    }
    refuse(from, name, value,
           "a picture stands in the file itself, as \"data:image/png;base64,...\" (png, jpeg or webp)");
  }

  // What stands in a style wins over an attribute of the same name, as everywhere.
  void copy_style(pugi::xml_node from, std::string_view style, pugi::xml_node to) {
    while (!style.empty()) {
      const std::size_t end = std::min(style.find(';'), style.size());
      const std::string_view declaration = style.substr(0, end);
      style.remove_prefix(std::min(end + 1, style.size()));
      const std::size_t colon = declaration.find(':');
      if (colon == std::string_view::npos) continue;
      const std::string_view property = trimmed(declaration.substr(0, colon));
      if (!is_presentation(property)) {
        refuse_harmful(from, property, trimmed(declaration.substr(std::min(colon + 1, declaration.size()))));
      } else {
        copy_value(from, property, std::string(without_importance(trimmed(declaration.substr(colon + 1)))),
                   to);
      }
    }
  }

  // What is left out in silence says how something looks; what loads something is told.
  void refuse_harmful(pugi::xml_node from, std::string_view name, std::string_view value) {
    if (!is_harmless(value))
      return refuse(from, name, std::string(value), "only plain values, and url(#id) of the drawing itself");
    if (const auto missed = missed_property(name, value))
      miss("C0646", missed->what, from.offset_debug(), std::string(name) + " is left out: " + missed->what,
           missed->hint);
  }

  void copy_value(pugi::xml_node from, std::string_view name, const std::string& value, pugi::xml_node to) {
    if (!is_harmless(value))
      return refuse(from, name, value, "only plain values, and url(#id) of the drawing itself");
    set(to, name, with_own_ids(value));
  }

  void refuse(pugi::xml_node from, std::string_view name, const std::string& value, const char* hint) {
    tell("C0642", from.offset_debug(),
         "the attribute " + std::string(name) + "=\"" + value.substr(0, 60) + "\" of <" + from.name() +
             "> is refused",
         hint);
  }

  static void set(pugi::xml_node node, std::string_view name, const std::string& value) {
    const std::string key(name);
    pugi::xml_attribute attribute = node.attribute(key.c_str());
    if (!attribute) attribute = node.append_attribute(key.c_str());
    attribute = with_line_ends(value).c_str();
  }

  // Without one the drawing could not be fitted to the page.
  void give_view_box(pugi::xml_node root, pugi::xml_node drawn) {
    const std::string width = root.attribute("width").as_string();
    const std::string height = root.attribute("height").as_string();
    drawn.remove_attribute("width");
    drawn.remove_attribute("height");
    if (root.attribute("viewBox")) return;  // that of a wrong one is told
    const double w = std::strtod(width.c_str(), nullptr);
    const double h = std::strtod(height.c_str(), nullptr);
    if (!(w > 0 && h > 0 && std::isfinite(w) && std::isfinite(h)))
      return tell("C0640", root.offset_debug(), "the drawing has no size",
                  "viewBox=\"0 0 800 400\", or width and height");
    std::ostringstream box;
    box << "0 0 " << w << ' ' << h;
    set(drawn, "viewBox", box.str());
  }

  struct Remark {
    const char* code;
    std::ptrdiff_t offset;
    std::string message;
    std::string hint;
    std::size_t count = 1;
  };

  const std::string& name_;
  std::string_view text_;
  pugi::xml_document in_;
  pugi::xml_document out_;
  result::Diagnostics mistakes_;
  std::size_t elements_ = 0;
  std::map<std::string, Remark> missed_;  // by what is missed
  bool seen_ = false;                     // something is drawn
  std::vector<Part> parts_;
  std::set<std::string> keys_;
  std::vector<BoundName> names_;
  std::vector<std::ptrdiff_t> offsets_;  // of the elements that are bound to them
};

}  // namespace

result::Result<Drawing> read_drawing(const std::string& name, std::string_view text) {
  if (text.size() > kLargestFile)
    return result::fail("C0640", {name, 0, 0}, "the file is larger than 2 MiB",
                        "leave out pictures and what is too small to be seen");
  return Reader(name, text).read();
}

result::Result<Drawing> load_drawing(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file, error))
    return result::fail("C0640", {file.string(), 0, 0}, "the drawing cannot be read",
                        "[hmi] drawing is a file beside the cell's configuration");
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return read_drawing(file.string(), text);
}

}  // namespace stepwright::drawing

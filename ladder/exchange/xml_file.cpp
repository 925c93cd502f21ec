#include "ladder/exchange/xml_file.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <utility>

#include "ladder/exchange/xml_encoding.h"
#include "ladder/source/codes.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::exchange {
namespace {

constexpr unsigned kParse = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol |
                            pugi::parse_wconv_attribute | pugi::parse_doctype | pugi::parse_comments |
                            pugi::parse_ws_pcdata_single;

// Walks a document without recursion.
struct DepthGuard : pugi::xml_tree_walker {
  pugi::xml_node too_deep;
  bool for_each(pugi::xml_node& node) override {
    if (depth() < XmlFile::kMaxDepth) return true;
    too_deep = node;
    return false;
  }
};

std::size_t utf8_length(std::string_view digits) {
  const bool hex = !digits.empty() && (digits[0] == 'x' || digits[0] == 'X');
  const unsigned long code =
      std::strtoul(std::string(digits.substr(hex ? 1 : 0)).c_str(), nullptr, hex ? 16 : 10);
  return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

// Length of an entity at `raw`, and of what it stands for; {0, 0} if there is none.
std::pair<std::size_t, std::size_t> entity(std::string_view raw) {
  const std::size_t end = raw.substr(0, 12).find(';');
  if (end == std::string_view::npos || end < 2) return {0, 0};
  const std::string_view name = raw.substr(1, end - 1);
  if (name[0] == '#') return {end + 1, utf8_length(name.substr(1))};
  for (const std::string_view known : {"lt", "gt", "amp", "quot", "apos"})
    if (name == known) return {end + 1, 1};
  return {0, 0};
}

// Anchors of a decoded text whose raw form begins at `file` of `raw`.
void anchor_text(std::string_view raw, std::uint32_t file, std::string_view decoded, bool escapes,
                 std::uint32_t base, std::vector<graphic::TextAnchor>& anchors) {
  anchors.push_back({base, file});
  std::size_t at = file;
  for (std::size_t i = 0; i < decoded.size() && at < raw.size();) {
    std::size_t used = 1;
    std::size_t made = 1;
    if (escapes && raw[at] == '&') {
      const auto [length, decoded_length] = entity(raw.substr(at));
      if (length != 0) used = length, made = decoded_length;
    } else if (raw[at] == '\r' && at + 1 < raw.size() && raw[at + 1] == '\n') {
      used = 2;
    }
    at += used;
    i += made;
    if (used != made)
      anchors.push_back({base + static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(at)});
  }
}

bool is_block(pugi::xml_node node) {
  const std::string_view name = local_name(node);
  return name == "p" || name == "pre" || name == "div" || name == "br";
}

bool is_space(const char* text) {
  return text[std::strspn(text, " \t\r\n")] == '\0';
}

}  // namespace

result::Result<XmlFile> XmlFile::parse(std::string name, std::string text) {
  const auto fail = [&](result::Location where, std::string message, std::string hint) {
    where.file = name;
    return result::fail(source::code::kBadXml, where, std::move(message), std::move(hint));
  };
  if (text.size() > kMaxBytes) return fail({}, "the file is larger than 64 MiB", "split the project");
  XmlFile file;
  file.name_ = name;
  auto read = as_utf8(name, std::move(text));
  if (!read) return result::forward(read);
  file.text_ = std::move(*read);
  if (file.text_.starts_with(result::kByteOrderMark)) file.skipped_ = result::kByteOrderMark.size();
  const pugi::xml_parse_result parsed = file.document_.load_buffer(
      file.text_.data() + file.skipped_, file.text_.size() - file.skipped_, kParse, pugi::encoding_utf8);
  if (!parsed) {
    const auto offset = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
    return fail(file.location(offset + file.skipped_),
                std::string("this is no well-formed XML: ") + parsed.description(),
                "is the file complete, and every element closed?");
  }
  for (const pugi::xml_node node : file.document_.children())
    if (node.type() == pugi::node_doctype)
      return fail(file.location(file.offset(node)), "document types are not read",
                  "remove the <!DOCTYPE ...>; PLCopen files need none");
  DepthGuard guard;
  file.document_.traverse(guard);
  if (guard.too_deep)
    return fail(file.location(file.offset(guard.too_deep)), "elements are nested too deeply",
                "256 levels are read");
  return file;
}

std::uint32_t XmlFile::offset(pugi::xml_node node) const {
  const std::ptrdiff_t offset = node.offset_debug();
  return offset < 0 ? 0 : static_cast<std::uint32_t>(offset) + skipped_;
}

result::Location XmlFile::location(std::uint32_t offset) const {
  const auto end =
      text_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(text_.size()));
  const auto line = static_cast<std::uint32_t>(std::count(text_.begin(), end, '\n'));
  auto start = end;
  while (start != text_.begin() && *(start - 1) != '\n') --start;
  const auto column =
      std::count_if(start, end, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return {name_, line + 1, static_cast<std::uint32_t>(column) + 1};
}

void XmlFile::append(pugi::xml_node node, graphic::SourceText& out) const {
  for (const pugi::xml_node each : node.children()) {
    const bool cdata = each.type() == pugi::node_cdata;
    if (cdata || each.type() == pugi::node_pcdata) {
      // Space between elements is layout of the file, not of the text.
      const bool layout =
          !cdata && is_space(each.value()) && (each.next_sibling() || each.previous_sibling());
      if (layout) continue;
      anchor_text(text_, offset(each), each.value(), !cdata, static_cast<std::uint32_t>(out.text.size()),
                  out.anchors);
      out.text += each.value();
    } else if (each.type() == pugi::node_element) {
      if (is_block(each) && !out.text.empty() && out.text.back() != '\n') out.text += '\n';
      append(each, out);
    }
  }
}

graphic::SourceText XmlFile::source_text(pugi::xml_node node) const {
  graphic::SourceText out;
  append(node, out);
  return out;
}

std::string_view local_name(pugi::xml_node node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_node each : node.children())
    if (local_name(each) == name) return each;
  return {};
}

graphic::Extra extra_of(pugi::xml_node node, std::initializer_list<std::string_view> attributes,
                        std::initializer_list<std::string_view> children) {
  graphic::Extra extra;
  for (const pugi::xml_attribute each : node.attributes())
    if (std::find(attributes.begin(), attributes.end(), each.name()) == attributes.end())
      extra.attributes.emplace_back(each.name(), each.value());
  std::ostringstream out;
  for (const pugi::xml_node each : node.children())
    if (each.type() == pugi::node_element &&
        std::find(children.begin(), children.end(), local_name(each)) == children.end())
      each.print(out, "", pugi::format_raw);
  extra.children = out.str();
  return extra;
}

void append_attributes(pugi::xml_node node, const graphic::Extra& extra) {
  for (const auto& [name, value] : extra.attributes)
    if (!node.attribute(name.c_str())) node.append_attribute(name.c_str()) = value.c_str();
}

void append_children(pugi::xml_node node, const graphic::Extra& extra) {
  if (extra.children.empty()) return;
  node.append_buffer(extra.children.data(), extra.children.size(),
                     pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_fragment,
                     pugi::encoding_utf8);
}

}  // namespace stepwright::exchange

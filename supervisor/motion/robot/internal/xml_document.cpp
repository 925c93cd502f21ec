#include "supervisor/motion/robot/internal/xml_document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "runtime/ground/result/utf8_place.h"
#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion::internal {

namespace {

constexpr unsigned kParseOptions = pugi::parse_escapes | pugi::parse_eol | pugi::parse_wconv_attribute |
                                   pugi::parse_doctype | pugi::parse_cdata;

struct DepthOf : pugi::xml_tree_walker {
  pugi::xml_node too_deep;
  bool for_each(pugi::xml_node& node) override {
    if (depth() < XmlDocument::kMaxDepth) return true;
    too_deep = node;
    return false;
  }
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// The numbers of a text, as many as `values` takes; false where there are others, fewer or more.
bool read_numbers(std::string_view text, double* values, std::size_t count) {
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t k = 0; k < count; ++k) {
    while (at != end && is_blank(*at)) ++at;
    if (at != end && *at == '+') ++at;
    const auto [next, problem] = std::from_chars(at, end, values[k]);
    if (problem != std::errc{} || (next != end && !is_blank(*next))) return false;
    at = next;
  }
  while (at != end && is_blank(*at)) ++at;
  return at == end;
}

}  // namespace

result::Result<XmlDocument> XmlDocument::parse(std::string_view text, std::string name) {
  XmlDocument file;
  file.name_ = std::move(name);
  const auto refuse = [&](result::Location where, std::string message, std::string hint) {
    return result::fail(code::kBadXml, std::move(where), std::move(message), std::move(hint));
  };
  if (text.size() > kMaxBytes)
    return refuse({file.name_}, "the file is larger than 16 MiB", "meshes belong in files of their own");
  if (text.starts_with(result::kByteOrderMark)) text.remove_prefix(result::kByteOrderMark.size());
  file.text_ = text;
  if (text.find('\0') != std::string_view::npos)
    return refuse(file.location(text.find('\0')), "the file is not UTF-8", "save it with the encoding UTF-8");
  const pugi::xml_parse_result parsed =
      file.document_.load_buffer(file.text_.data(), file.text_.size(), kParseOptions, pugi::encoding_utf8);
  if (!parsed)
    return refuse(file.location(static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0))),
                  std::string("this is no well-formed XML: ") + parsed.description(),
                  "is the file complete, and every element closed?");
  for (const pugi::xml_node node : file.document_.children())
    if (node.type() == pugi::node_doctype)
      return refuse(file.at(node), "document types are not read", "remove the <!DOCTYPE ...>");
  DepthOf depth;
  file.document_.traverse(depth);
  if (depth.too_deep)
    return refuse(file.at(depth.too_deep), "elements are nested too deeply", "64 levels are read");
  return file;
}

std::size_t XmlDocument::offset_of(pugi::xml_node node) const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

result::Location XmlDocument::at(pugi::xml_node node) const {
  return location(offset_of(node));
}

result::Location XmlDocument::at(pugi::xml_node node, const char* attribute) const {
  const std::string_view name = attribute;
  char quote = '\0';
  for (std::size_t k = offset_of(node); k < text_.size(); ++k) {
    const char c = text_[k];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      break;
    } else if (is_blank(c) && text_.compare(k + 1, name.size(), name) == 0 &&
               k + 1 + name.size() < text_.size() &&
               (text_[k + 1 + name.size()] == '=' || is_blank(text_[k + 1 + name.size()]))) {
      return location(k + 1);
    }
  }
  return at(node);
}

result::Location XmlDocument::location(std::size_t offset) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
  const auto lines = std::count(text_.begin(), end, '\n');
  auto start = end;
  while (start != text_.begin() && *(start - 1) != '\n') --start;
  const auto column =
      std::count_if(start, end, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return {name_, static_cast<std::uint32_t>(lines) + 1, static_cast<std::uint32_t>(column) + 1};
}

void Reader::complain(const char* code, result::Location where, std::string message, std::string hint) {
  if (found_.size() < kMostMessages)
    found_.push_back({code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
}

pugi::xml_node Reader::child(pugi::xml_node node, const char* name, bool needed) {
  const pugi::xml_node first = node.child(name);
  if (!first) {
    if (needed)
      complain(code::kBadMember, document_.at(node),
               std::string("<") + node.name() + "> has no <" + name + ">");
    return first;
  }
  if (const pugi::xml_node second = first.next_sibling(name))
    complain(code::kBadMember, document_.at(second),
             std::string("<") + name + "> is there twice in one <" + node.name() + ">");
  return first;
}

void Reader::missing(pugi::xml_node node, const char* attribute) {
  complain(code::kBadMember, document_.at(node),
           std::string("<") + node.name() + "> has no attribute '" + attribute + "'");
}

std::string Reader::text(pugi::xml_node node, const char* attribute) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found || *found.value() == '\0') {
    missing(node, attribute);
    return {};
  }
  constexpr std::size_t kLongest = 1024;
  if (std::string_view(found.value()).size() > kLongest) {
    complain(code::kTooLarge, document_.at(node, attribute), "the text is longer than 1024 bytes");
    return {};
  }
  return found.value();
}

double Reader::number(pugi::xml_node node, const char* attribute, std::optional<double> otherwise) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) {
    if (!otherwise) missing(node, attribute);
    return otherwise.value_or(0.0);
  }
  double value = 0.0;
  if (!read_numbers(found.value(), &value, 1)) {
    complain(
        code::kBadMember, document_.at(node, attribute),
        std::string("'") + attribute + "' is no number: \"" + std::string(found.value()).substr(0, 40) + "\"",
        "is this a xacro file? expand it first");
    return otherwise.value_or(0.0);
  }
  if (!std::isfinite(value)) {
    complain(code::kOutOfRange, document_.at(node, attribute),
             std::string("'") + attribute + "' is not finite");
    return otherwise.value_or(0.0);
  }
  return value;
}

Vector3 Reader::vector(pugi::xml_node node, const char* attribute, std::optional<Vector3> otherwise) {
  const Vector3 fallback = otherwise.value_or(Vector3{});
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) {
    if (!otherwise) missing(node, attribute);
    return fallback;
  }
  std::array<double, 3> values{};
  if (!read_numbers(found.value(), values.data(), values.size())) {
    complain(code::kBadMember, document_.at(node, attribute),
             std::string("'") + attribute + "' is not three numbers: \"" +
                 std::string(found.value()).substr(0, 60) + "\"",
             "as in \"0 0.5 1\"");
    return fallback;
  }
  const Vector3 value{values[0], values[1], values[2]};
  if (!is_finite(value)) {
    complain(code::kOutOfRange, document_.at(node, attribute),
             std::string("'") + attribute + "' is not finite");
    return fallback;
  }
  return value;
}

}  // namespace stepwright::motion::internal

#pragma once

// An XML file with the places of its elements and attributes: pugixml behind a small wall. Internal to this
// folder.
//
// Only UTF-8 is read, no document type is (so there are no entities beyond XML's own and nothing is fetched),
// and size and depth are bounded: any input gives a document or a located diagnostic.

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/spatial/vector.h"

namespace stepwright::motion::internal {

class XmlDocument {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{16} << 20U;
  static constexpr int kMaxDepth = 64;

  [[nodiscard]] static result::Result<XmlDocument> parse(std::string_view text, std::string name);

  pugi::xml_node root() const { return document_.document_element(); }
  // Where an element begins, and an attribute of it; of the element where it has no such attribute.
  result::Location at(pugi::xml_node node) const;
  result::Location at(pugi::xml_node node, const char* attribute) const;

 private:
  result::Location location(std::size_t offset) const;
  std::size_t offset_of(pugi::xml_node node) const;

  std::string name_;
  std::string text_;
  pugi::xml_document document_;
};

// Reads members of elements and collects what is wrong with them, all at once, up to 100 messages.
class Reader {
 public:
  static constexpr std::size_t kMostMessages = 100;

  explicit Reader(const XmlDocument& document) : document_(document) {}

  void complain(const char* code, result::Location where, std::string message, std::string hint = {});
  bool failed() const { return !found_.empty(); }
  std::size_t count() const { return found_.size(); }
  result::Diagnostics take() { return std::move(found_); }

  // The only child of that name; nothing and a message where it is needed and missing, or there twice.
  pugi::xml_node child(pugi::xml_node node, const char* name, bool needed);
  // Each gives `otherwise` where there is no such attribute, and complains where it is wrong or needed and
  // missing.
  std::string text(pugi::xml_node node, const char* attribute);
  double number(pugi::xml_node node, const char* attribute, std::optional<double> otherwise);
  Vector3 vector(pugi::xml_node node, const char* attribute, std::optional<Vector3> otherwise);

  const XmlDocument& document() const { return document_; }

 private:
  void missing(pugi::xml_node node, const char* attribute);

  const XmlDocument& document_;
  result::Diagnostics found_;
};

}  // namespace stepwright::motion::internal

#pragma once

// An XML file with places: pugixml behind a small wall. Internal to this folder.
//
// Only UTF-8 is read, no document type is (so there are no entities beyond XML's own and nothing is fetched),
// and size and depth are bounded: any input gives a document or a located diagnostic.

#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "ladder/graphic/diagram.h"
#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

class XmlFile {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
  static constexpr int kMaxDepth = 256;

  // Parses; fails with E0801.
  [[nodiscard]] static result::Result<XmlFile> parse(std::string name, std::string text);

  pugi::xml_node root() const { return document_.document_element(); }
  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }

  // Byte of the file where a node begins; for text the first character.
  std::uint32_t offset(pugi::xml_node node) const;
  result::Location location(std::uint32_t offset) const;

  // The text below `node` (paragraphs of XHTML are lines), with the places of its pieces.
  graphic::SourceText source_text(pugi::xml_node node) const;

 private:
  void append(pugi::xml_node node, graphic::SourceText& out) const;

  std::string name_;
  std::string text_;
  std::uint32_t skipped_ = 0;  // bytes of a byte order mark
  pugi::xml_document document_;
};

// The name without its prefix.
std::string_view local_name(pugi::xml_node node);
pugi::xml_node child(pugi::xml_node node, std::string_view name);

// Everything of `node` that is not among these.
graphic::Extra extra_of(pugi::xml_node node, std::initializer_list<std::string_view> attributes,
                        std::initializer_list<std::string_view> children);
void append_attributes(pugi::xml_node node, const graphic::Extra& extra);
void append_children(pugi::xml_node node, const graphic::Extra& extra);

}  // namespace stepwright::exchange

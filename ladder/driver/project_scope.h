#pragma once

// Scope of a diagram of a project: types of variables, interfaces of POUs, places in the file. Internal to
// this folder; one thread.

#include <map>
#include <span>
#include <string>

#include "ladder/graphic/project.h"
#include "ladder/lowering/diagram_scope.h"
#include "ladder/syntax/parser.h"
#include "ladder/syntax/piece.h"

namespace stepwright::driver {

// Interfaces of all POUs and members of all structures, by upper-case name.
class ProgramInterfaces {
 public:
  void add(const syntax::Unit& unit, const source::NameTable& names);
  void add(const graphic::Project& project);

  const lowering::Signature* signature(const std::string& type) const;
  // The ST text of the type that a name stands for; the name itself if it stands for none.
  std::string type_behind(std::string name) const;
  // Type of a variable below `base`, with the tokens behind its name: ".field[1].more"; empty if unknown.
  std::string type_below(std::string base, std::span<const syntax::Token> path) const;
  std::string type_of_global(const std::string& name) const;

 private:
  std::string type_of_member(const std::string& base, std::string_view name) const;

  std::map<std::string, lowering::Signature> pous_;
  std::map<std::string, std::string> types_;    // ST text of the type
  std::map<std::string, std::string> globals_;  // its type
};

class ProjectScope final : public lowering::DiagramScope {
 public:
  // `file` is the project's in the sources; all must outlive this.
  ProjectScope(const graphic::Pou& pou, const ProgramInterfaces& interfaces, source::FileId file,
               syntax::SyntaxContext& context)
      : pou_(pou), interfaces_(interfaces), file_(file), context_(context) {}

  std::string type_of(const std::string& variable) const override;
  bool is_private(const std::string& variable) const override;
  const lowering::Signature* signature(const std::string& type) const override {
    return interfaces_.signature(type);
  }
  std::string mark(std::uint32_t where) const override;
  result::Location location(std::uint32_t where) const override;
  void note(std::uint32_t where, const std::string& what) override;
  std::string piece(const graphic::SourceText& text, syntax::PieceKind kind, std::uint32_t where) override;
  void error(const char* code, std::uint32_t where, std::string message, std::string hint) override;
  void warning(const char* code, std::uint32_t where, std::string message, std::string hint) override;
  std::string new_wire() override { return "__W" + std::to_string(wires_++) + "_"; }

  // The texts that people see: no marks.
  void hide_marks() { marks_ = false; }

 private:
  const graphic::Pou& pou_;
  const ProgramInterfaces& interfaces_;
  source::FileId file_;
  syntax::SyntaxContext& context_;
  mutable syntax::PieceReader reader_;  // learns spellings, nothing else
  std::size_t wires_ = 0;
  bool marks_ = true;
};

// A text of a file as a piece of it (SourceSet::add_piece); without anchors it is a text of its own.
source::FileId add_text(source::SourceSet& sources, source::FileId file, const std::string& name,
                        const graphic::SourceText& text);

}  // namespace stepwright::driver

// Which line instructions come from.

#include <algorithm>

#include "ladder/codegen/expression_emitter.h"

namespace stepwright::codegen {

std::uint32_t FileTable::index_of(source::Position where) {
  const std::string note = sources_.note(where);
  // Nearly every line is of a text: no name is put together for it.
  if (note.empty() && where.file == plain_file_) return plain_index_;
  std::string name = file_names_[where.file.value];
  if (!note.empty()) name += " (" + note + ")";
  name = ContainerLimits::name(std::move(name));
  const auto [found, added] = index_.try_emplace(std::move(name), static_cast<std::uint32_t>(names_.size()));
  if (added) names_.push_back(found->first);
  if (note.empty()) {
    plain_file_ = where.file;
    plain_index_ = found->second;
  }
  return found->second;
}

void ExpressionEmitter::line(source::Position where) {
  here_ = where;
  const source::LineColumn place = files_.sources().line_column(where);
  b_.line(files_.index_of(where), place.line, place.column);
}

// Only where another line begins: the statement's place does for the rest.
void ExpressionEmitter::locate(source::Position where) {
  const source::SourceSet& sources = files_.sources();
  if (where.file != here_.file || sources.line(where) != sources.line(here_)) line(where);
}

void ExpressionEmitter::call_site(source::Position where, const semantics::Pou& callee) {
  const bool marked = here_ == where || !files_.sources().is_library(callee.where.file);
  marked ? locate(where) : line(where);
}

}  // namespace stepwright::codegen

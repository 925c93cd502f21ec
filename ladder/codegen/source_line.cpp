// Which line instructions come from.

#include <algorithm>

#include "ladder/codegen/expression_emitter.h"

namespace stepwright::codegen {

std::uint32_t FileTable::index_of(source::FileId file) {
  const auto known = std::find(files_.begin(), files_.end(), file);
  if (known == files_.end()) {
    files_.push_back(file);
    return static_cast<std::uint32_t>(files_.size() - 1);
  }
  return static_cast<std::uint32_t>(known - files_.begin());
}

void ExpressionEmitter::line(source::Position where) {
  here_ = where;
  const result::Location place = files_.sources().location(where);
  b_.line(files_.index_of(where.file), place.line, place.column);
}

// Only where another line begins: the statement's place does for the rest.
void ExpressionEmitter::locate(source::Position where) {
  const source::SourceSet& sources = files_.sources();
  if (where.file != here_.file || sources.line(where) != sources.line(here_)) line(where);
}

}  // namespace stepwright::codegen

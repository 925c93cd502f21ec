#include "ladder/source/source_set.h"

#include <algorithm>
#include <utility>

namespace stepwright::source {

FileId SourceSet::add(std::string name, std::string text) {
  auto file = std::make_unique<File>();
  file->name = std::move(name);
  file->text = std::move(text);
  file->line_starts.push_back(0);
  for (std::size_t at = file->text.find('\n'); at != std::string::npos; at = file->text.find('\n', at + 1))
    file->line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  files_.push_back(std::move(file));
  return FileId(static_cast<std::uint32_t>(files_.size() - 1));
}

std::uint32_t SourceSet::line(Position position) const {
  const auto& starts = files_[position.file.value]->line_starts;
  return static_cast<std::uint32_t>(std::upper_bound(starts.begin(), starts.end(), position.offset) -
                                    starts.begin());
}

result::Location SourceSet::location(Position position) const {
  // Something that is missing from an empty compilation has no place.
  if (position.file.value >= files_.size()) return {};
  const File& file = *files_[position.file.value];
  const std::uint32_t line_number = line(position);
  const std::size_t end = std::min<std::size_t>(position.offset, file.text.size());
  std::uint32_t column = 1;
  for (std::size_t i = file.line_starts[line_number - 1]; i < end; ++i) {
    const bool continues_character = (static_cast<unsigned char>(file.text[i]) & 0xC0u) == 0x80u;
    if (!continues_character) ++column;
  }
  return {file.name, line_number, column};
}

}  // namespace stepwright::source

#include "ladder/source/source_set.h"

#include <algorithm>
#include <utility>

namespace stepwright::source {

FileId SourceSet::add(std::string name, std::string text, Author author) {
  auto file = std::make_unique<File>();
  file->name = std::move(name);
  file->text = std::move(text);
  file->author = author;
  file->line_starts.push_back(0);
  for (std::size_t at = file->text.find('\n'); at != std::string::npos; at = file->text.find('\n', at + 1))
    file->line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  files_.push_back(std::move(file));
  return FileId(static_cast<std::uint32_t>(files_.size() - 1));
}

FileId SourceSet::add_piece(std::string text, FileId file, std::vector<Anchor> anchors) {
  const FileId id = add({}, std::move(text));
  files_.back()->origin = file;
  files_.back()->anchors = std::move(anchors);
  return id;
}

Position SourceSet::home(Position position) const {
  const File& file = *files_[position.file.value];
  if (file.anchors.empty()) return position;
  auto next =
      std::upper_bound(file.anchors.begin(), file.anchors.end(), position.offset,
                       [](std::uint32_t offset, const Anchor& anchor) { return offset < anchor.text; });
  if (next != file.anchors.begin()) --next;
  return {file.origin, next->file + (position.offset - next->text)};
}

void SourceSet::add_note(Position where, std::string text) {
  files_[where.file.value]->notes[where.offset] = std::move(text);
}

std::string SourceSet::note(Position place) const {
  if (place.file.value >= files_.size()) return {};  // of no file: there is no PROGRAM at all
  const Position position = home(place);
  const auto& notes = files_[position.file.value]->notes;
  const auto next = notes.upper_bound(position.offset);
  return next == notes.begin() ? std::string() : std::prev(next)->second;
}

std::uint32_t SourceSet::line(Position place) const {
  const Position position = home(place);
  const auto& starts = files_[position.file.value]->line_starts;
  return static_cast<std::uint32_t>(std::upper_bound(starts.begin(), starts.end(), position.offset) -
                                    starts.begin());
}

result::Location SourceSet::location(Position place) const {
  // Something that is missing from an empty compilation has no place.
  if (place.file.value >= files_.size()) return {};
  const Position position = home(place);
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

#include "ladder/source/source_set.h"

#include <algorithm>
#include <utility>

namespace stepwright::source {

namespace {

constexpr std::size_t kBlock = 256;

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

std::vector<std::uint32_t> count_continued(const std::string& text) {
  if (std::none_of(text.begin(), text.end(), continues_character)) return {};
  std::vector<std::uint32_t> counts{0};
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (continues_character(text[i])) ++count;
    if ((i + 1) % kBlock == 0) counts.push_back(count);
  }
  return counts;
}

}  // namespace

std::uint32_t SourceSet::File::continued_before(std::size_t offset) const {
  if (continued.empty()) return 0;
  const std::size_t block = offset / kBlock;
  const auto from = text.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
  const auto to = text.begin() + static_cast<std::ptrdiff_t>(offset);
  return continued[block] + static_cast<std::uint32_t>(std::count_if(from, to, continues_character));
}

FileId SourceSet::add(std::string name, std::string text, Author author) {
  auto file = std::make_unique<File>();
  file->name = std::move(name);
  file->text = std::move(text);
  file->author = author;
  file->line_starts.push_back(0);
  for (std::size_t at = file->text.find('\n'); at != std::string::npos; at = file->text.find('\n', at + 1))
    file->line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  file->continued = count_continued(file->text);
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
  const LineColumn at = line_column(place);
  return {name(place.file), at.line, at.column};
}

LineColumn SourceSet::line_column(Position place) const {
  const Position position = home(place);
  const File& file = *files_[position.file.value];
  const std::uint32_t line_number = line(position);
  const std::uint32_t start = file.line_starts[line_number - 1];
  const std::size_t end = std::min<std::size_t>(position.offset, file.text.size());
  const std::size_t bytes = end > start ? end - start : 0;
  const std::uint32_t continued = bytes > 0 ? file.continued_before(end) - file.continued_before(start) : 0;
  return {line_number, static_cast<std::uint32_t>(bytes) - continued + 1};
}

}  // namespace stepwright::source

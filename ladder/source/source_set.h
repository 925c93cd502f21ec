#pragma once

// The texts of one compilation and the places in them.
//
// A SourceSet owns its texts: views into them stay valid as long as the set lives (also when it is moved).
// Not thread-safe; one set belongs to one compilation.
//
//   SourceSet sources;
//   FileId file = sources.add("blink.st", text);
//   sources.location({file, 17});  ->  {"blink.st", 2, 5}

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/strong_id.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::source {

struct FileTag;
using FileId = base::StrongId<FileTag>;

// A text and the name under which diagnostics speak of it: a path, or the name of a POU of a project.
struct NamedText {
  std::string name;
  std::string text;
};

// Who wrote a text: the user, or it came with the compiler.
enum class Author : std::uint8_t { User, Library };

// A byte of a text.
struct Position {
  FileId file;
  std::uint32_t offset = 0;

  friend bool operator==(const Position&, const Position&) = default;
};

// From byte `text` of a piece on, its bytes are those of its file from `file` on.
struct Anchor {
  std::uint32_t text = 0;
  std::uint32_t file = 0;
};

// Both from 1.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

class SourceSet {
 public:
  // Takes a copy of the text.
  FileId add(std::string name, std::string text, Author author = Author::User);
  // A piece of `file` that was decoded (a body in an XML file): what is said about the piece is said about
  // the file. `anchors` are sorted and not empty.
  FileId add_piece(std::string text, FileId file, std::vector<Anchor> anchors);

  // Names the place from this position of a file to the next note: a POU and an element of its diagram.
  void add_note(Position where, std::string text);
  // Empty if there is none.
  std::string note(Position position) const;

  std::size_t size() const { return files_.size(); }
  const std::string& name(FileId file) const { return files_[home({file, 0}).file.value]->name; }
  std::string_view text(FileId file) const { return files_[file.value]->text; }
  // False for what has no file.
  bool is_library(FileId file) const {
    return file.value < files_.size() && files_[file.value]->author == Author::Library;
  }

  // Offset of the first byte of a line that the file has.
  std::uint32_t line_start(FileId file, std::uint32_t line) const {
    return files_[file.value]->line_starts[line - 1];
  }
  // Line, from 1. An offset behind the end gives the last line.
  std::uint32_t line(Position position) const;
  // File, line and column; columns count characters (UTF-8), not bytes. No location without the file.
  result::Location location(Position position) const;
  // The same without the name of the file. Requires a position in a file of the set.
  LineColumn line_column(Position position) const;

 private:
  struct File {
    std::string name;
    std::string text;
    Author author = Author::User;
    std::vector<std::uint32_t> line_starts;
    // Bytes that go on with a character begun before, up to each kBlock-th byte: a column is known without
    // a walk along its line. Empty for a text of ASCII.
    std::vector<std::uint32_t> continued;

    std::uint32_t continued_before(std::size_t offset) const;
    FileId origin;                // of a piece
    std::vector<Anchor> anchors;  // empty = no piece
    std::map<std::uint32_t, std::string> notes;
  };
  // The place in the file that a piece was taken from; any other place as it is.
  Position home(Position position) const;

  std::vector<std::unique_ptr<File>> files_;
};

}  // namespace stepwright::source

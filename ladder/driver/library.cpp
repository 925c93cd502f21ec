#include "ladder/driver/library.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>

#include "ladder/driver/library_texts.h"
#include "ladder/semantics/model/model.h"
#include "ladder/source/codes.h"

namespace stepwright::driver {

namespace {

constexpr std::string_view kReservedFiles[] = {"library/bistables.st", "library/counters.st",
                                               "library/timers.st"};

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The name of the declaration that begins a line; empty if none does. In the library, declarations and
// nothing else begin in the first column.
std::string_view declared_name(std::string_view line) {
  for (const std::string_view word : {"FUNCTION_BLOCK ", "FUNCTION ", "TYPE "}) {
    if (line.substr(0, word.size()) != word) continue;
    const std::string_view rest = line.substr(word.size());
    const auto end = std::find_if_not(rest.begin(), rest.end(), is_name_letter);
    return rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  }
  return {};
}

void add_declarations(std::size_t text, std::vector<LibraryDeclaration>& out) {
  const LibraryText& file = library_texts()[text];
  const bool reserved = std::ranges::count(kReservedFiles, file.name) != 0;
  std::size_t at = 0;
  while (at < file.text.size()) {
    const std::string_view name = declared_name(file.text.substr(at, 80));
    if (!name.empty()) {
      if (!out.empty() && out.back().text == text) out.back().end = static_cast<std::uint32_t>(at);
      out.push_back({name, file.name, text, static_cast<std::uint32_t>(at),
                     static_cast<std::uint32_t>(file.text.size()), reserved});
    }
    const std::size_t end = file.text.find('\n', at);
    at = end == std::string_view::npos ? file.text.size() : end + 1;
  }
}

// What the user's sources declare, by name.
std::unordered_map<std::uint32_t, source::Position> declared_names(const syntax::Unit& unit) {
  std::unordered_map<std::uint32_t, source::Position> names;
  for (const auto& each : unit.pous) names.try_emplace(each.name.id.value, each.name.where);
  for (const auto& each : unit.types) names.try_emplace(each.name.id.value, each.name.where);
  return names;
}

}  // namespace

std::vector<LibraryDeclaration> library_declarations() {
  std::vector<LibraryDeclaration> declarations;
  for (std::size_t i = 0; i < library_texts().size(); ++i) add_declarations(i, declarations);
  return declarations;
}

void add_library(syntax::SyntaxContext& context, syntax::Unit& unit) {
  std::vector<LibraryDeclaration> open = library_declarations();
  const auto taken = declared_names(unit);
  std::vector<std::optional<source::FileId>> files(library_texts().size());
  // A declaration that is parsed names others, so this goes on until a round finds nothing.
  for (bool found = true; found;) {
    found = false;
    std::erase_if(open, [&](const LibraryDeclaration& each) {
      auto id = context.names.find(each.name);
      // What tells whether a function has a value comes with the function.
      if (!id && each.name.starts_with(semantics::kConditionPrefix))
        id = context.names.find(each.name.substr(semantics::kConditionPrefix.size()));
      if (!id) return false;
      if (const auto user = taken.find(id->value); user != taken.end()) {
        if (each.reserved)
          context.sink.error(source::code::kDuplicate, user->second,
                             "'" + std::string(each.name) + "' is a standard function block",
                             "standard function blocks have their names for themselves");
        return true;
      }
      auto& file = files[each.text];
      if (!file)
        file = context.sources.add(std::string(each.file), std::string(library_texts()[each.text].text),
                                   source::Author::Library);
      syntax::parse_unit(context, *file, unit, syntax::TextKind::Written, {each.begin, each.end});
      found = true;
      return true;
    });
  }
}

}  // namespace stepwright::driver

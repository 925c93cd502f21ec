#pragma once

// Reads names and atoms of a binding file and checks each against what declares it: the tags and sensors of
// the file itself and the planning domain's vocabulary. Private to supervisor/translate.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/settings/toml_document.h"
#include "supervisor/model/vocabulary.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate::internal {

using settings::TomlTable;

enum class AtomKind : std::uint8_t { Action, Fact, Fluent };

class AtomReader {
 public:
  // `vocabulary` may be null; the others must outlive the reader.
  AtomReader(const Binding& binding, const model::Vocabulary* vocabulary) noexcept
      : binding_(binding), vocabulary_(vocabulary) {}

  // A name that is not declared is a problem of the file, which fails as a whole; its pattern is returned all
  // the same, so that one slip is reported once. Nullopt only for a text that is no atom.
  // The atom of `key` (required). `scope` is the action pattern whose variables it may use, null for a ground
  // atom; an Action declares its variables itself.
  std::optional<Pattern> atom(const TomlTable& table, std::string_view key, AtomKind kind,
                              const Pattern* scope);
  // The same for a text that was fetched already; `key` is its place.
  std::optional<Pattern> parse(const TomlTable& table, std::string_view key, const std::string& text,
                               AtomKind kind, const Pattern* scope);
  // An atom that a switch or sensor of this file must observe for some object at least.
  std::optional<Pattern> observed(const TomlTable& table, std::string_view key, const std::string& text,
                                  AtomKind kind, const Pattern* scope);
  // A tag that is declared; null and a diagnostic if there is none.
  const Tag* tag(const TomlTable& table, std::string_view key, const std::string& name);
  // A BOOL tag in the output area.
  const Tag* output(const TomlTable& table, std::string_view key, const std::string& name);

  void problem(const char* code, const TomlTable& table, std::string_view key, std::string message,
               std::string hint = {});
  result::Diagnostics take_problems() { return std::move(problems_); }

 private:
  bool known(const TomlTable& table, std::string_view key, const Pattern& pattern, AtomKind kind);
  void bound(const TomlTable& table, std::string_view key, const Pattern& pattern, const Pattern* scope);

  const Binding& binding_;
  const model::Vocabulary* vocabulary_;
  result::Diagnostics problems_;
};

// "did you mean 'x'?" or the list of what there is.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace stepwright::translate::internal

#include <algorithm>
#include <utility>

#include "supervisor/translate/internal/binding_reader.h"
#include "supervisor/translate/read_binding.h"

namespace stepwright::translate {

namespace {

using Document = result::Result<std::unique_ptr<settings::TomlDocument>>;

result::Result<Binding> read_document(Document document, std::string file,
                                      const model::Vocabulary* vocabulary) {
  if (!document) return result::forward(document);
  return read_binding(**document, std::move(file), vocabulary);
}

}  // namespace

result::Result<Binding> read_binding(settings::TomlDocument& document, std::string file,
                                     const model::Vocabulary* vocabulary) {
  internal::BindingReader reader(std::move(file), vocabulary);
  reader.read(document.root());
  result::Diagnostics problems = document.finish();
  for (result::Diagnostic& problem : reader.take_problems()) problems.push_back(std::move(problem));
  if (problems.empty()) return reader.take_binding();
  std::stable_sort(problems.begin(), problems.end(), [](const auto& a, const auto& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
  return tl::unexpected(std::move(problems));
}

result::Result<Binding> read_binding(std::string_view text, std::string file,
                                     const model::Vocabulary* vocabulary) {
  return read_document(settings::TomlDocument::parse(text, file, "B"), file, vocabulary);
}

result::Result<Binding> load_binding(const std::filesystem::path& file, const model::Vocabulary* vocabulary) {
  return read_document(settings::TomlDocument::load(file, "B"), file.string(), vocabulary);
}

}  // namespace stepwright::translate

#include "ladder/driver/compile.h"

#include <algorithm>
#include <utility>

#include "ladder/driver/container_names.h"
#include "ladder/driver/front_end.h"
#include "ladder/driver/sheets.h"
#include "ladder/driver/unshown_notes.h"
#include "ladder/print/program_document.h"
#include "runtime/bytecode/writer/document_section.h"

namespace stepwright::driver {

namespace {

// Files as the container names them: equal sources give equal documents wherever they are compiled.
void name_files(std::vector<graphic::Sheet>& sheets, const std::string& folder) {
  std::vector<std::string> files;
  for (const graphic::Sheet& each : sheets)
    if (std::find(files.begin(), files.end(), each.file) == files.end()) files.push_back(each.file);
  const std::vector<std::string> names = container_names(files, folder);
  for (graphic::Sheet& each : sheets)
    each.file =
        names[static_cast<std::size_t>(std::find(files.begin(), files.end(), each.file) - files.begin())];
}

bool has_pragmas(const CompileInput& input) {
  return std::ranges::any_of(
      input.texts, [](const source::NamedText& each) { return each.text.find('{') != std::string::npos; });
}

// What is read once more for people: the document of the container, if it is wanted, and warnings of pragmas.
// What cannot be drawn has no document; it runs all the same.
void add_sources(const CompileInput& input, const semantics::Model& model, std::vector<std::byte>& container,
                 source::DiagnosticSink& sink) {
  const bool document = input.document && !container.empty();
  if (!document && !has_pragmas(input)) return;
  auto sheets = sheets_of(input);
  if (!sheets) return;
  warn_of_unshown_notes(*sheets, model, sink);
  if (!document) return;
  name_files(*sheets, input.folder);
  container = writer::with_document(container, print::program_document(*sheets));
}

// What is said of a watcher is said of what it was made from.
result::Diagnostics at_origins(result::Diagnostics diagnostics, std::span<const Watcher> watchers) {
  for (result::Diagnostic& each : diagnostics) {
    const auto watcher = std::ranges::find(watchers, each.where.file, &Watcher::name);
    if (watcher == watchers.end() || watcher->origins.empty()) continue;
    const std::size_t line = std::min<std::size_t>(std::max(each.where.line, 1u), watcher->origins.size());
    each.where = watcher->origins[line - 1];
  }
  return diagnostics;
}

}  // namespace

result::Result<CompileOutput> compile(const CompileInput& input) {
  FrontEnd front(input);
  source::DiagnosticSink& sink = front.sink();
  // Tests are checked and left behind: the container is that of the same sources without them.
  for (const semantics::TestGroup& each : front.test_groups()) front.analyze(&each);
  const auto model = front.analyze();
  if (sink.has_errors()) return tl::unexpected(at_origins(sink.take(), input.watchers));
  CompileOutput output;
  const bool runs = !model->instances.empty() || !input.library;
  if (runs) {
    auto container = front.container(*model);
    if (!container) return result::forward(container);
    output.container = std::move(*container);
  }
  add_sources(input, *model, output.container, sink);
  lint::check(*model, front.unit(), front.user_pous(), input.lint, sink);
  output.warnings = at_origins(lint::without_suppressed(sink.take(), front.sources()), input.watchers);
  return output;
}

}  // namespace stepwright::driver

#include "ladder/driver/compile.h"

#include <utility>

#include "ladder/driver/front_end.h"
#include "ladder/driver/sheets.h"
#include "ladder/print/program_document.h"
#include "runtime/bytecode/writer/document_section.h"

namespace stepwright::driver {

namespace {

// What cannot be drawn has no document; it runs all the same.
std::vector<std::byte> with_sources(std::vector<std::byte> container, const CompileInput& input) {
  const auto sheets = sheets_of(input);
  if (!sheets) return container;
  return writer::with_document(container, print::program_document(*sheets));
}

}  // namespace

result::Result<CompileOutput> compile(const CompileInput& input) {
  FrontEnd front(input);
  source::DiagnosticSink& sink = front.sink();
  // Tests are checked and left behind: the container is that of the same sources without them.
  for (const semantics::TestGroup& each : front.test_groups()) front.analyze(&each);
  const auto model = front.analyze();
  if (sink.has_errors()) return tl::unexpected(sink.take());
  auto container = front.container(*model);
  if (!container) return result::forward(container);
  CompileOutput output;
  output.container = input.document ? with_sources(std::move(*container), input) : std::move(*container);
  lint::check(*model, front.unit(), front.user_pous(), input.lint, sink);
  output.warnings = lint::without_suppressed(sink.take(), front.sources());
  return output;
}

}  // namespace stepwright::driver

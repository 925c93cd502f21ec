#include "ladder/driver/compile.h"

#include <utility>

#include "ladder/driver/front_end.h"

namespace stepwright::driver {

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
  output.container = std::move(*container);
  lint::check(*model, front.unit(), front.user_pous(), input.lint, sink);
  output.warnings = lint::without_suppressed(sink.take(), front.sources());
  return output;
}

}  // namespace stepwright::driver

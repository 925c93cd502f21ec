#include "ladder/lint/lint.h"

#include "ladder/lint/internal/body_walker.h"
#include "ladder/lint/internal/rules.h"

namespace stepwright::lint {

void check(const semantics::Model& model, const syntax::Unit& unit, std::size_t user_pous, Level level,
           source::DiagnosticSink& sink) {
  if (level == Level::None) return;
  internal::Uses uses(model, unit, user_pous);
  internal::name_declarations(uses);
  std::uint64_t writes = 0;
  for (std::size_t i = 0; i < user_pous; ++i) {
    internal::BodyWalker(uses, i, level, writes, sink).run();
    internal::check_values(*model.pous[i], level, sink);
  }
  const internal::Reached reached = internal::reached_of(model);
  internal::check_unused(uses, sink);
  internal::check_never_written(uses, sink);
  internal::check_dropped(uses, sink);
  internal::check_outputs(uses, reached, sink.sources(), sink);
  if (level != Level::All) return;
  internal::check_unused_pous(uses, reached, sink);
  internal::check_hidden(uses, sink);
}

}  // namespace stepwright::lint

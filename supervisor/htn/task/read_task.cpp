#include "supervisor/htn/task/read_task.h"

#include "supervisor/htn/syntax/parser.h"
#include "supervisor/htn/task/resolver.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20;  // its tokens take thirty times as much

result::Diagnostics too_large(const lisp::Source& source) {
  if (source.text.size() <= kMostBytes) return {};
  return {{"P0606",
           result::Severity::Error,
           {source.file, 0, 0},
           "the text is larger than " + std::to_string(kMostBytes >> 20) + " MB",
           "is this the right file?"}};
}

}  // namespace

result::Result<ReadTask> read_task(const lisp::Source& domain, const lisp::Source& problem,
                                   const std::vector<std::string>& external) {
  for (const lisp::Source* source : {&domain, &problem})
    if (auto refused = too_large(*source); !refused.empty()) return tl::unexpected(std::move(refused));
  lisp::Reporter reporter({domain.file, problem.file});
  const ParsedDomain parsed_domain = parse_domain(lisp::tokens_of(domain.text, 0, reporter), reporter);
  const ParsedProblem parsed_problem = parse_problem(lisp::tokens_of(problem.text, 1, reporter), reporter);
  // What a broken section declares is missing; complaints about those names would only hide the cause.
  if (reporter.failed()) return tl::unexpected<result::Diagnostics>(reporter.take());
  ReadTask read{resolve(parsed_domain, parsed_problem, external, reporter), {}};
  const bool failed = reporter.failed();
  result::Diagnostics diagnostics = reporter.take();
  if (failed) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  read.warnings = std::move(diagnostics);
  return read;
}

}  // namespace stepwright::htn

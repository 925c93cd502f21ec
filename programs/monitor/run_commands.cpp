#include <cstdio>
#include <limits>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::monitor {
namespace {

int perform(const config::CellConfig& config, service::RequestBody request, const char* done) {
  auto runtime = Attached::open(config, service::Role::Controller);
  if (!runtime) return process::fail(runtime.error(), result::ExitCode::BadInput);
  auto reply = (*runtime)->ask(std::move(request));
  if (!reply) return process::fail(reply.error(), result::ExitCode::BadInput);
  std::printf("%s\n", done);
  return to_int(result::ExitCode::Done);
}

}  // namespace

int start(const config::CellConfig& config, const StartArguments& arguments) {
  return perform(config, service::Start{.barrier = false, .cold = arguments.cold},
                 arguments.cold ? "started, with initial values" : "started, with retained values");
}

int stop(const config::CellConfig& config) {
  return perform(config, service::Stop{"somebody at the machine"},
                 "stopped, with the outputs in their safe state");
}

int fault(const config::CellConfig& config, const FaultArguments& arguments) {
  constexpr double kEnds = std::numeric_limits<double>::quiet_NaN();
  if (!arguments.clear && !arguments.value) {
    std::fputs("stepwright fault: a VALUE, or --clear\n", stderr);
    return to_int(result::ExitCode::Usage);
  }
  return perform(config, service::InjectFault{arguments.name, arguments.clear ? kEnds : *arguments.value},
                 arguments.clear ? "the fault has ended" : "the plant has the fault");
}

}  // namespace stepwright::monitor

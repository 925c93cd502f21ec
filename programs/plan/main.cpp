// The process behind `stepwright plan` and `stepwright validate`.

#include <CLI/CLI.hpp>

#include "programs/plan/output.h"
#include "programs/plan/plan_command.h"
#include "programs/plan/validate_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

void describe_plan(CLI::App& app, plan::PlanArguments& arguments) {
  app.add_option("domain", arguments.domain, "the PDDL domain")->required();
  app.add_option("problem", arguments.problem, "the PDDL problem")->required();
  auto* optimal =
      app.add_flag("--optimal", arguments.optimal, "prove the optimum; no time limit unless --time");
  app.add_flag("--first", arguments.first, "end with the first plan")->excludes(optimal);
  app.add_option("--time", arguments.time_s, "time budget in seconds (default 10)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--memory", arguments.memory_mb, "memory budget in MB (default 4096)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 24));
  app.add_option("--threads", arguments.threads,
                 "2: one improves plans while the other proves; 1: the same plan every time (default 2)")
      ->check(CLI::Range(1u, 2u));
  app.add_flag("--progress", arguments.progress, "show the progress also where stderr is no terminal");
  app.add_option("--json", arguments.json_file, "write the outcome and its figures as JSON");
  app.add_option("--out", arguments.out_file, "write the plan, each one as soon as it is found");
  auto* svg = app.add_option("--svg", arguments.picture.svg_file, "draw schedule and causal graph");
  app.add_option("--binding", arguments.picture.binding_file, "durations and shared outputs for --svg")
      ->needs(svg);
  app.footer(
      "Exit codes: 0 a plan was found (the last line says whether it is proved optimal), 1 wrong input, 2 "
      "wrong usage, 3 no plan exists (proved), 4 the budget ended, or Ctrl-C or SIGTERM came, before there "
      "was a plan.");
}

void describe_validate(CLI::App& app, plan::ValidateArguments& arguments) {
  app.add_option("domain", arguments.domain, "the PDDL domain")->required();
  app.add_option("problem", arguments.problem, "the PDDL problem")->required();
  app.add_option("plan", arguments.plan, "the plan, one action per line")->required();
  app.add_option("--json", arguments.json_file, "write every step as JSON");
  app.add_flag("--quiet", arguments.quiet, "no table of steps");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plans PDDL problems and checks plans", "stepwright");
  app.require_subcommand(1);
  plan::PlanArguments plan_arguments;
  plan::ValidateArguments validate_arguments;
  CLI::App* plan_command = app.add_subcommand("plan", "find a plan, improve it, prove it optimal");
  CLI::App* validate_command =
      app.add_subcommand("validate", "execute a plan step by step and say if it holds");
  describe_plan(*plan_command, plan_arguments);
  describe_validate(*validate_command, validate_arguments);
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  const result::ExitCode exit =
      plan_command->parsed() ? plan::run_plan(plan_arguments) : plan::run_validate(validate_arguments);
  return result::to_int(exit);
}

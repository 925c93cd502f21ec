#include "programs/plan/plan_picture.h"

#include "programs/plan/output.h"
#include "supervisor/pddl/describe_run.h"
#include "supervisor/pddl/vocabulary.h"
#include "supervisor/translate/plan_svg.h"

namespace stepwright::plan {
namespace {

template <typename T>
bool failed(const result::Result<T>& value) {
  if (!value) print_diagnostics(value.error());
  return !value;
}

}  // namespace

bool draw_plan(const pddl::Task& task, const model::Plan& plan, const PictureArguments& arguments) {
  if (arguments.svg_file.empty()) return true;
  const auto run = pddl::describe_run(task, plan);
  if (failed(run)) return false;
  if (arguments.binding_file.empty()) {
    return write_file(arguments.svg_file, translate::plan_svg(*run, translate::unit_schedule(*run), "steps"));
  }
  const model::Vocabulary vocabulary = pddl::vocabulary(task);
  const auto binding = translate::load_binding(arguments.binding_file, &vocabulary);
  if (failed(binding)) return false;
  const auto schedule = translate::schedule(*run, *binding, false);
  if (failed(schedule)) return false;
  return write_file(arguments.svg_file, translate::plan_svg(*run, *schedule));
}

}  // namespace stepwright::plan

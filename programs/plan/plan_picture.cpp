#include "programs/plan/plan_picture.h"

#include "programs/plan/output.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/pddl/task/vocabulary.h"
#include "supervisor/translate/plan_svg.h"

namespace stepwright::plan {
namespace {

template <typename T>
bool failed(const result::Result<T>& value) {
  if (!value) print_diagnostics(value.error());
  return !value;
}

}  // namespace

std::optional<PlanPicture> PlanPicture::prepare(const pddl::Task& task, const PictureArguments& arguments) {
  PlanPicture picture(arguments.svg_file);
  if (arguments.svg_file.empty() || arguments.binding_file.empty()) return picture;
  const model::Vocabulary vocabulary = pddl::vocabulary(task);
  auto binding = translate::load_binding(arguments.binding_file, &vocabulary);
  if (failed(binding)) return std::nullopt;
  picture.binding_ = std::move(*binding);
  return picture;
}

bool PlanPicture::draw(const pddl::Task& task, const model::Plan& plan) const {
  if (svg_file_.empty()) return true;
  const auto run = pddl::describe_run(task, plan);
  if (failed(run)) return false;
  if (!binding_) {
    return write_file(svg_file_, translate::plan_svg(*run, translate::unit_schedule(*run), "steps"));
  }
  const auto schedule = translate::schedule(*run, *binding_, false);
  if (failed(schedule)) return false;
  return write_file(svg_file_, translate::plan_svg(*run, *schedule));
}

}  // namespace stepwright::plan

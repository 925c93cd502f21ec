#include "programs/hmi/dds_cell_control.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>
#include <utility>

#include "hmi_web/api/cell_codes.h"
#include "runtime/service/program_names.h"

namespace stepwright::hmi {
namespace {

using result::Result;

constexpr std::chrono::milliseconds kLongestForValues{1'000};
constexpr std::chrono::milliseconds kBetweenLooks{10};

tl::unexpected<result::Diagnostics> just_changed() {
  return result::fail(api::kProgramJustChanged, {}, "the program has just changed", "try again in a moment");
}

// Names of the program that runs at this moment, as far as is known here. What is asked by them names that
// program, so that no other is hit.
class RunningNames {
 public:
  static Result<RunningNames> of(DdsCellSource& source) {
    auto program = source.running().get();
    const auto status = source.client().status();
    if (!program || !status)
      return result::fail(api::kNobodyAnswers, {}, "no runtime answers with a program",
                          "is the runtime of the cell running?");
    if (status->program_digest != program->digest) return just_changed();
    return RunningNames(std::move(program));
  }
  const std::string& digest() const { return program_->digest; }
  service::ProgramNames operator*() const { return {program_->digest, program_->info}; }

 private:
  explicit RunningNames(std::shared_ptr<const KnownProgram> program) : program_(std::move(program)) {}
  std::shared_ptr<const KnownProgram> program_;
};

Result<service::NamedBits> value_of(DdsCellSource& source, const std::string& name, const std::string& text) {
  auto names = RunningNames::of(source);
  if (!names) return result::forward(names);
  return (**names).value(name, text);
}

Result<service::NamedWrite> written(DdsCellSource& source, const std::string& name, const std::string& text) {
  auto names = RunningNames::of(source);
  if (!names) return result::forward(names);
  return (**names).written(name, text);
}

// A controller without an operating system takes a single part, and no block.
service::RequestBody request_of(host::BlockWrite block) {
  if (block.parts.size() == 1) return service::Write{{block.program_digest, block.parts.front()}};
  return service::WriteBlock{std::move(block)};
}

api::ForcedPlace told(const service::ForcedValue& forced) {
  return {forced.name, forced.text(), forced.ends};
}

}  // namespace

Result<void> DdsCellControl::ask_supervisor(const std::string& request) {
  return source_.plans().request(request);
}

std::string DdsCellControl::goal_form() {
  return source_.plans().goal_form().value_or("");
}

std::string DdsCellControl::outlook() {
  return source_.plans().outlook().value_or("");
}

Result<void> DdsCellControl::stop_runtime(const std::string& reason) {
  return source_.client().stop(reason);
}

// A runtime that was started again answers before its first values are here. A refusal is an answer, too.
Result<void> DdsCellControl::reach() {
  auto answer = source_.client().ask(service::ReadForces{});
  if (!answer && answer.error().front().code == api::kNobodyAnswers) return result::forward(answer);
  const auto status = source_.client().status();
  const auto end = std::chrono::steady_clock::now() + kLongestForValues;
  while (status && std::chrono::steady_clock::now() < end) {
    const auto snapshot = source_.client().snapshot();
    if (snapshot && snapshot->incarnation == status->incarnation) break;
    std::this_thread::sleep_for(kBetweenLooks);
  }
  return {};
}

Result<std::string> DdsCellControl::read(const std::string& name) {
  auto names = RunningNames::of(source_);
  if (!names) return result::forward(names);
  if (auto written = recent_.of(name, images())) return std::move(*written);
  const auto snapshot = source_.client().snapshot();
  const auto status = source_.client().status();
  // A runtime that was started again has other values than the one before.
  const bool is_old = snapshot && status && snapshot->incarnation != status->incarnation;
  if (!snapshot || is_old || snapshot->program_digest != names->digest())
    return result::fail(api::kNobodyAnswers, {}, "no values of this program have arrived");
  return (**names).read(name, snapshot->image);
}

std::shared_ptr<const tags::KnownTags> DdsCellControl::known_tags() {
  const auto known = source_.running().get();
  if (!known) return nullptr;
  return std::make_shared<const tags::KnownTags>(
      said_, tags::DeclaredNotes(known->info.instances(), known->document));
}

std::shared_ptr<const reader::ProgramInfo> DdsCellControl::program() {
  auto known = source_.running().get();
  if (!known) return nullptr;
  const reader::ProgramInfo* const info = &known->info;
  return {std::move(known), info};
}

Result<std::string> DdsCellControl::spell(const std::string& name, const std::string& value) {
  auto wanted = written(source_, name, value);
  if (!wanted) return result::forward(wanted);
  return std::move(wanted->text);
}

Result<std::string> DdsCellControl::write(const std::string& name, const std::string& value) {
  auto wanted = written(source_, name, value);
  if (!wanted) return result::forward(wanted);
  if (auto done = source_.client().ask(request_of(std::move(wanted->block))); !done)
    return result::forward(done);
  recent_.note(name, wanted->text, images());
  return std::move(wanted->text);
}

Result<std::string> DdsCellControl::force(const std::string& name, const std::string& value,
                                          std::chrono::milliseconds duration) {
  auto wanted = value_of(source_, name, value);
  if (!wanted) return result::forward(wanted);
  const service::Force request{{wanted->bits, static_cast<std::uint64_t>(duration.count())}};
  if (auto done = source_.client().ask(request); !done) return result::forward(done);
  return std::move(wanted->text);
}

Result<void> DdsCellControl::unforce(const std::string& name) {
  auto names = RunningNames::of(source_);
  if (!names) return result::forward(names);
  auto place = (**names).forceable(name);
  if (!place) return result::forward(place);
  if (auto done = source_.client().ask(service::Unforce{place->bits}); !done) return result::forward(done);
  return {};
}

Result<void> DdsCellControl::write_together(const std::map<std::string, std::string, std::less<>>& values) {
  // All of one program, or none.
  auto names = RunningNames::of(source_);
  if (!names) return result::forward(names);
  host::BlockWrite block{names->digest(), {}};
  for (const auto& [name, value] : values) {
    auto wanted = (**names).written(name, value);
    if (!wanted) return result::forward(wanted);
    std::ranges::move(wanted->block.parts, std::back_inserter(block.parts));
  }
  if (auto done = source_.client().ask(service::WriteBlock{std::move(block)}); !done)
    return result::forward(done);
  return {};
}

Result<std::vector<host::PlantFault>> DdsCellControl::faults() {
  if (!source_.client().runtime_alive()) return result::fail(api::kNobodyAnswers, {}, "no runtime answers");
  return source_.client().faults();
}

Result<void> DdsCellControl::set_fault(const std::string& name, std::optional<double> value) {
  constexpr double kEnds = std::numeric_limits<double>::quiet_NaN();
  auto done = source_.client().ask(service::InjectFault{name, value.value_or(kEnds)});
  if (!done) return result::forward(done);
  return {};
}

Result<std::vector<api::ForcedPlace>> DdsCellControl::forced() {
  // Asked often, from where nobody waits for a runtime to come.
  if (!source_.client().runtime_alive()) return result::fail(api::kNobodyAnswers, {}, "no runtime answers");
  auto forces = source_.client().forces();
  if (!forces) return result::forward(forces);
  std::vector<api::ForcedPlace> places;
  if (forces->places.empty()) return places;
  const auto program = source_.running().get();
  if (!program || program->digest != forces->program_digest) return just_changed();
  const service::ProgramNames names(program->digest, program->info);
  for (const image::Force& force : forces->places) places.push_back(told(names.forced(force)));
  return places;
}

Result<api::ForcedPlace> DdsCellControl::as_forced(const std::string& name, const std::string& value) {
  auto names = RunningNames::of(source_);
  if (!names) return result::forward(names);
  auto forced = (**names).as_forced(name, value);
  if (!forced) return result::forward(forced);
  return told(*forced);
}

}  // namespace stepwright::hmi

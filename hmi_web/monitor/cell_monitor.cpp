#include "hmi_web/monitor/cell_monitor.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "hmi_web/monitor/chart_picture.h"
#include "hmi_web/protocol/json_text.h"
#include "hmi_web/protocol/program_document.h"
#include "hmi_web/server/image_value.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;
using protocol::TagRange;

constexpr std::size_t kMostKept = 8;      // sheets in their instances, and pictures
constexpr std::size_t kMostRanges = 200;  // of tags or blocks
constexpr std::uint32_t kMostOfRange = 100'000;

const std::string& given_text(const api::CellMonitor::Parameters& given, std::string_view name) {
  static const std::string none;
  const auto found = given.find(name);
  return found == given.end() ? none : found->second;
}

std::optional<std::uint32_t> number_of(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// "0-3,7": what cannot be read is left out.
std::vector<TagRange> ranges_of(std::string_view text) {
  std::vector<TagRange> ranges;
  while (!text.empty() && ranges.size() < kMostRanges) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    const auto dash = part.find('-');
    const auto first = number_of(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : number_of(part.substr(dash + 1));
    if (first && last && *last >= *first && *last - *first < kMostOfRange)
      ranges.push_back({*first, *last - *first + 1});
  }
  return ranges;
}

api::Answer no_program() {
  return api::refused(404, "H0066", "no program is known to this server",
                      "download one; the page shows it as soon as the runtime has it");
}

json tags_json(const server::ProgramLayout& layout, std::span<const std::byte> image,
               const std::vector<TagRange>& ranges) {
  json tags = json::object();
  for (const TagRange& range : ranges) {
    const std::size_t end = std::min<std::size_t>(layout.tags.size(), std::size_t{range.first} + range.count);
    for (std::size_t i = range.first; i < end; ++i) {
      const reader::Variable& variable = layout.tags[i];
      const auto text = server::read_text(variable, image);
      const auto value = server::read(variable, image);
      tags[std::to_string(i)] =
          text ? json(*text) : protocol::value_json(value, variable.type == bytecode::ElementaryType::Real);
    }
  }
  return tags;
}

json steps_json(const server::ProgramLayout& layout, std::span<const std::byte> image) {
  json steps = json::array();
  for (std::size_t i = 0; i < layout.steps.size(); ++i)
    if (server::read(layout.steps[i], image).value_or(0) != 0) steps.push_back(i);
  return steps;
}

}  // namespace

struct CellMonitor::Program {
  explicit Program(std::shared_ptr<const server::ProgramLayout> of) : layout(std::move(of)), names(*layout) {}

  // Null if the document has no such sheet.
  std::shared_ptr<const SheetMonitor> sheet(std::uint32_t number, const std::string& instance) const {
    for (const Kept& each : sheets)
      if (each.number == number && each.instance == instance) return each.monitor;
    const json document = protocol::parsed_document(layout->document);
    if (!document.is_object() || number >= document["sheets"].size()) return nullptr;
    auto monitor =
        std::make_shared<const SheetMonitor>(names, read_sheet(document["sheets"][number]), instance);
    if (sheets.size() == kMostKept) sheets.pop_front();
    sheets.push_back({number, instance, monitor});
    return monitor;
  }

  struct Kept {
    std::uint32_t number;
    std::string instance;
    std::shared_ptr<const SheetMonitor> monitor;
  };
  std::shared_ptr<const server::ProgramLayout> layout;
  ProgramNames names;
  mutable std::mutex mutex;  // guards what is kept of it, and looks at it
  mutable std::deque<Kept> sheets;
  mutable std::deque<std::pair<std::string, api::Answer>> pictures;  // by what was asked for
};

CellMonitor::CellMonitor() : moment_(std::make_shared<const Moment>()) {}
CellMonitor::~CellMonitor() = default;

std::shared_ptr<const CellMonitor::Moment> CellMonitor::now() const {
  const std::lock_guard lock(mutex_);
  return moment_;
}

const server::ImageSnapshot* CellMonitor::Moment::snapshot() const {
  const bool readable = seen != nullptr && seen->layout != nullptr && seen->snapshot;
  return readable ? &*seen->snapshot : nullptr;
}

std::span<const std::byte> CellMonitor::Moment::image() const {
  const server::ImageSnapshot* const newest = snapshot();
  return newest == nullptr ? std::span<const std::byte>() : std::span(newest->image);
}

void CellMonitor::take(std::shared_ptr<const server::Observation> seen) {
  const auto before = now();
  Moment next;
  next.program = before->program;  // while the runtime is away
  const bool same = before->program != nullptr && before->program->layout == seen->layout;
  if (seen->layout != nullptr && !same) next.program = std::make_shared<const Program>(seen->layout);
  next.seen = std::move(seen);
  auto made = std::make_shared<const Moment>(std::move(next));
  const std::lock_guard lock(mutex_);
  moment_ = std::move(made);
}

api::Answer CellMonitor::live(const Parameters& given) const {
  const auto moment = now();
  if (moment->program == nullptr) return no_program();
  const Program& program = *moment->program;
  const server::ImageSnapshot* const newest = moment->snapshot();
  json answer = {{"digest", program.layout->program.digest},
                 {"scan", newest == nullptr ? 0 : newest->scan},
                 {"steps", steps_json(*program.layout, moment->image())},
                 {"tags", tags_json(*program.layout, moment->image(), ranges_of(given_text(given, "tags")))},
                 {"blocks", json::object()}};
  const std::lock_guard lock(program.mutex);
  const auto number = number_of(given_text(given, "sheet"));
  const auto sheet = number ? program.sheet(*number, given_text(given, "instance")) : nullptr;
  if (sheet != nullptr)
    answer["blocks"] = sheet->look(types_, moment->image(), ranges_of(given_text(given, "blocks")));
  return {.text = protocol::text(answer)};
}

api::Answer CellMonitor::chart(const Parameters& given) const {
  const auto moment = now();
  if (moment->program == nullptr) return no_program();
  const Program& program = *moment->program;
  ExitChoice choice{given_text(given, "exits") == "1", {}};
  for (const TagRange& each : ranges_of(given_text(given, "shown")))
    for (std::uint32_t i = 0; i < each.count; ++i) choice.shown.insert(each.first + i);
  const std::string& name = given_text(given, "chart");
  const std::string key = name + '\n' + given_text(given, "exits") + '\n' + given_text(given, "shown");
  const std::lock_guard lock(program.mutex);
  for (const auto& [asked, answer] : program.pictures)
    if (asked == key) return answer;
  json picture = chart_picture(program.layout->program, name, choice);
  if (picture.is_null()) return api::refused(404, "H0130", "the running program has no chart of that name");
  picture["digest"] = program.layout->program.digest;
  api::Answer answer{.text = protocol::text(picture)};
  if (program.pictures.size() == kMostKept) program.pictures.pop_front();
  program.pictures.emplace_back(key, answer);
  return answer;
}

}  // namespace stepwright::monitor

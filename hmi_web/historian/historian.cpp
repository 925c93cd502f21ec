#include "hmi_web/historian/historian.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hmi_web/historian/internal/core.h"
#include "hmi_web/historian/visitors.h"

namespace stepwright::historian {
namespace {

constexpr std::size_t kLongestName = 255;

result::Result<void> check_settings(const std::string& name, const SuppressionSettings& settings) {
  const auto wrong = [](std::string message, std::string hint) {
    return result::fail("S0012", {}, std::move(message), std::move(hint));
  };
  if (name.empty() || name.size() > kLongestName)
    return wrong("a tag's name has " + std::to_string(name.size()) + " bytes", "1 to 255");
  if (!(settings.deviation >= 0.0) || !std::isfinite(settings.deviation))
    return wrong("the deviation of " + name + " is no number of 0 or more", "in the unit of the tag");
  if (settings.longest_gap_ns <= 0) return wrong("the longest gap of " + name + " is not positive", "in ns");
  return {};
}

result::Result<void> check_window(Window window, std::size_t parts) {
  if (window.to_ns >= window.from_ns && parts > 0) return {};
  return result::fail("S0014", {}, parts == 0 ? "nothing is asked for" : "the window ends before it begins",
                      "give a window from..to in ns, and how many points are wanted");
}

}  // namespace

Historian::Historian(std::unique_ptr<Core> core) : core_(std::move(core)) {}
Historian::~Historian() = default;

result::Result<std::unique_ptr<Historian>> Historian::open(const std::filesystem::path& file,
                                                           HistorianOptions options) {
  auto core = std::make_unique<Core>(file, std::move(options));
  if (auto started = core->start(); !started) return result::forward(started);
  return std::unique_ptr<Historian>(new Historian(std::move(core)));
}

result::Result<TagId> Historian::tag(const std::string& name, const SuppressionSettings& settings) {
  if (auto sound = check_settings(name, settings); !sound) return result::forward(sound);
  const std::lock_guard lock(core_->state_mutex);
  const auto id = core_->tags.add(name, settings);
  if (!id) return result::fail("S0012", {}, "there are too many tags for " + name);
  return *id;
}

std::optional<TagId> Historian::find(const std::string& name) const {
  const std::lock_guard lock(core_->state_mutex);
  return core_->tags.find(name);
}

std::vector<std::string> Historian::names() const {
  const std::lock_guard lock(core_->state_mutex);
  std::vector<std::string> names;
  for (TagRow& row : core_->tags.names()) names.push_back(std::move(row.name));
  return names;
}

void Historian::append(TagId tag, const Sample& sample) {
  core_->queue.push(TagSample{tag, sample});
}
void Historian::append(std::span<const TagSample> samples) {
  core_->queue.push(samples);
}
result::Result<void> Historian::flush() {
  return core_->flush();
}
HistorianStatus Historian::status() const {
  return core_->status();
}

result::Result<Range> Historian::range(TagId tag, Window window, std::size_t most) const {
  if (auto sound = check_window(window, most); !sound) return result::forward(sound);
  RangeVisitor visitor(window, most);
  if (auto done = core_->read(tag, visitor); !done) return result::forward(done);
  // Blocks overlap only where samples came late.
  if (!std::ranges::is_sorted(visitor.samples, {}, &Sample::time_ns))
    std::ranges::stable_sort(visitor.samples, {}, &Sample::time_ns);
  return Range{std::move(visitor.samples), visitor.before, visitor.truncated, std::move(visitor.damage)};
}

result::Result<Trend> Historian::trend(TagId tag, Window window, std::size_t buckets) const {
  if (auto sound = check_window(window, buckets); !sound) return result::forward(sound);
  TrendVisitor visitor(window, buckets);
  if (auto done = core_->read(tag, visitor); !done) return result::forward(done);
  return Trend{visitor.bucket_ns(), std::move(visitor.buckets), visitor.before, std::move(visitor.damage)};
}

result::Result<std::vector<Damage>> Historian::export_csv(std::span<const TagId> tags, Window window,
                                                          const Sink& sink) const {
  if (auto sound = check_window(window, 1); !sound) return result::forward(sound);
  std::vector<Damage> damage;
  if (!sink("tag,time,value,quality\r\n")) return damage;
  for (const TagId tag : tags) {
    std::string name;
    {
      const std::lock_guard lock(core_->state_mutex);
      name = core_->tags.name(tag);
    }
    CsvVisitor visitor(window, name, sink);
    if (auto done = core_->read(tag, visitor); !done) return result::forward(done);
    damage.insert(damage.end(), visitor.damage.begin(), visitor.damage.end());
    if (!visitor.finish()) break;
  }
  return damage;
}

}  // namespace stepwright::historian

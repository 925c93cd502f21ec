#include "hmi_web/historian/historian.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hmi_web/historian/internal/core.h"
#include "hmi_web/historian/visitors.h"
#include "hmi_web/storage/codes.h"
#include "runtime/ground/result/last_barrier.h"

namespace stepwright::historian {
namespace {

constexpr std::size_t kMostTailBytes = 4 << 20;
constexpr std::chrono::minutes kCheckpointPeriod{10};
constexpr std::chrono::seconds kRetentionPeriod{1};
constexpr std::size_t kMostWarnings = 100;
constexpr std::size_t kMostViews = 4;
constexpr std::int64_t kPageBytes = 8192;

std::int64_t real_time_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

constexpr std::size_t kLongestName = 255;
// Of no tag: a time of note_until, in its place among the samples.
constexpr TagId kUntil(~0U - 1);

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
void Historian::note_until(std::int64_t time_ns) {
  core_->queue.push(TagSample{kUntil, {time_ns}});
}
std::int64_t Historian::known_until_ns() const {
  return core_->known_until_ns;
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

Historian::Core::Core(std::filesystem::path file, HistorianOptions options)
    : queue({options.batch_samples, options.most_queued_samples, options.commit_period}),
      tags(options.most_waiting_bytes),
      path_(std::move(file)),
      options_(std::move(options)) {}

Historian::Core::~Core() {
  queue.stop();
  if (thread_.joinable()) thread_.join();
}

result::Result<void> Historian::Core::start() {
  auto opened = open_file();
  if (!opened && options_.replace_damaged && storage::is_damage(opened.error())) {
    const auto told = storage::put_aside_warnings(std::move(opened.error()), storage::put_aside(path_));
    opened = open_file();
    warnings_.insert(warnings_.end(), told.begin(), told.end());
  }
  if (!opened) return opened;
  last_checkpoint_ = Clock::now();
  thread_ = std::thread([this] { run(); });
  return {};
}

result::Result<void> Historian::Core::open_file() {
  const auto pages = static_cast<std::int64_t>(options_.largest_file_bytes) / kPageBytes;
  auto file = HistoryFile::open(path_, options_.durable, pages);
  if (!file) return result::forward(file);
  return load(std::move(*file));
}

result::Result<void> Historian::Core::load(HistoryFile file) {
  result::Diagnostics warnings;
  auto stored = file.load(warnings);
  if (!stored) return result::forward(stored);
  for (StoredTag& tag : *stored) tags.restore(std::move(tag));
  warnings_ = std::move(warnings);
  file_.emplace(std::move(file));
  return {};
}

void Historian::Core::run() {
  std::vector<TagSample> batch;
  while (queue.take(batch)) {
    step([&] {
      write(batch, false);
      retain();
    });
    queue.done();
  }
  step([&] { write({}, true); });
}

void Historian::Core::step(const std::function<void()>& work) {
  const auto thrown = result::thrown_by(work);
  if (thrown)
    note_failure(
        result::fail(storage::kInputOutput, {path_.string()}, "the history cannot be written: " + *thrown)
            .value());
}

void Historian::Core::write(std::span<const TagSample> batch, bool last) {
  const bool checkpoint = last || checkpoint_due_ || tail_bytes_ > kMostTailBytes ||
                          Clock::now() - last_checkpoint_ > kCheckpointPeriod;
  WriteSet set;
  {
    const std::lock_guard lock(state_mutex);
    for (const TagSample& sample : batch) {
      if (sample.tag == kUntil) {
        known_until_ns = std::max<std::int64_t>(known_until_ns, sample.sample.time_ns);
      } else {
        tags.append(sample);
      }
    }
    if (last) tags.release_held();
    set = tags.collect(checkpoint);
  }
  const bool empty = set.tags.empty() && set.tail.empty() && set.open.empty() && tags.blocks().empty();
  if (empty && !checkpoint) return;
  if (!file_ && !reopen()) return;
  auto written = file_->write(set, tags.blocks(), tags.parents());
  if (!written) return note_failure(std::move(written.error()));
  tail_bytes_ = checkpoint ? 0 : tail_bytes_ + *written;
  if (checkpoint) {
    last_checkpoint_ = Clock::now();
    checkpoint_due_ = false;
  }
  const std::uint64_t used = file_->used_bytes().value_or(0);
  const std::lock_guard lock(state_mutex);
  tags.committed(set);
  ++figures_.commits;
  figures_.file_bytes = used;
  figures_.failing = false;
  figures_.problems.clear();
}

void Historian::Core::note_failure(result::Diagnostics problems) {
  const bool damaged = storage::is_damage(problems);
  {
    const std::lock_guard lock(state_mutex);
    figures_.failing = true;
    figures_.problems = std::move(problems);
  }
  if (damaged && options_.replace_damaged) begin_new_file();
}

// What is in memory goes to the new file with the next write.
void Historian::Core::begin_new_file() {
  file_.reset();
  {
    const std::lock_guard lock(view_mutex_);
    ++generation_;
    views_.clear();
  }
  const std::filesystem::path aside = storage::put_aside(path_);
  checkpoint_due_ = true;
  {
    const std::lock_guard lock(state_mutex);
    tags.begin_new_file();
    const auto told = storage::put_aside_warnings(figures_.problems, aside);
    if (warnings_.size() < kMostWarnings) warnings_.insert(warnings_.end(), told.begin(), told.end());
  }
  reopen();
}

bool Historian::Core::reopen() {
  const auto pages = static_cast<std::int64_t>(options_.largest_file_bytes) / kPageBytes;
  auto file = HistoryFile::open(path_, options_.durable, pages);
  if (file) {
    file_.emplace(std::move(*file));
    return true;
  }
  const std::lock_guard lock(state_mutex);
  figures_.failing = true;
  figures_.problems = std::move(file.error());
  return false;
}

void Historian::Core::retain() {
  const auto now = Clock::now();
  if (!file_ || now - last_retention_ < kRetentionPeriod) return;
  Kept kept{std::numeric_limits<std::int64_t>::min(), options_.most_bytes};
  if (options_.most_age.count() > 0) {
    const std::int64_t clock_ns = options_.now_ns ? options_.now_ns() : real_time_ns();
    kept.oldest_ns = clock_ns - std::chrono::nanoseconds(options_.most_age).count();
  }
  auto deleted = file_->retain(kept);
  if (!deleted) return note_failure(std::move(deleted.error()));
  if (deleted->empty()) last_retention_ = now;  // otherwise there may be more
  const std::lock_guard lock(state_mutex);
  tags.deleted(*deleted);
}

result::Result<void> Historian::Core::flush() {
  queue.flush();
  const std::lock_guard lock(state_mutex);
  if (figures_.failing) return tl::unexpected<result::Diagnostics>(figures_.problems);
  return {};
}

HistorianStatus Historian::Core::status() const {
  const std::lock_guard lock(state_mutex);
  HistorianStatus status = figures_;
  status.dropped = queue.dropped() + tags.unknown();
  status.appended = queue.pushed() + queue.dropped();
  status.kept = tags.kept();
  status.lost = tags.lost();
  status.problems.insert(status.problems.end(), warnings_.begin(), warnings_.end());
  return status;
}

result::Result<void> Historian::Core::read(TagId tag, Visitor& visitor) {
  std::optional<OpenPart> part;
  {
    const std::lock_guard lock(state_mutex);
    part = tags.open_part(tag);
  }
  if (!part)
    return result::fail("S0013", {path_.string()},
                        "there is no tag with the number " + std::to_string(tag.value));
  std::uint64_t generation = 0;
  auto view = borrow(generation);
  if (!view) return result::forward(view);
  auto done = view->begin();
  if (done) done = walk(*view, tag, *part, visitor);
  view->end();
  if (done) give_back(std::move(*view), generation);
  return done;
}

result::Result<HistoryView> Historian::Core::borrow(std::uint64_t& generation) {
  {
    const std::lock_guard lock(view_mutex_);
    generation = generation_;
    if (!views_.empty()) {
      HistoryView view = std::move(views_.back());
      views_.pop_back();
      return view;
    }
  }
  return HistoryView::open(path_);
}

void Historian::Core::give_back(HistoryView view, std::uint64_t generation) {
  const std::lock_guard lock(view_mutex_);
  if (generation == generation_ && views_.size() < kMostViews) views_.push_back(std::move(view));
}

}  // namespace stepwright::historian

#include "hmi_web/alarms/journal.h"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "hmi_web/alarms/internal/journal_file.h"
#include "hmi_web/storage/batch_queue.h"
#include "hmi_web/storage/codes.h"
#include "runtime/ground/naming/folded_text.h"
#include "runtime/ground/result/last_barrier.h"

namespace stepwright::alarms {

class AlarmJournal::Core {
 public:
  Core(std::filesystem::path file, std::vector<AlarmDefinition> definitions, JournalOptions options)
      : queue({kEnough, options.most_waiting, options.retry_period}),
        path(std::move(file)),
        options_(std::move(options)),
        definitions_(std::move(definitions)) {}
  ~Core() {
    queue.stop();
    if (thread_.joinable()) thread_.join();
  }

  result::Result<void> start() {
    auto opened = open();
    if (!opened && storage::is_damage(opened.error())) {
      warnings_ = storage::put_aside_warnings(std::move(opened.error()), storage::put_aside(path));
      opened = open();
    }
    if (opened) thread_ = std::thread([this] { run(); });
    return opened;
  }

  JournalStatus status() const {
    const std::lock_guard lock(mutex_);
    JournalStatus status = status_;
    status.appended = queue.pushed() + queue.dropped();
    status.dropped += queue.dropped();
    status.problems.insert(status.problems.end(), warnings_.begin(), warnings_.end());
    return status;
  }

  // Alarms whose text people read it in, in whatever language: each name in a line of its own, with a line
  // break at both ends; empty: there is none.
  std::string names_with(const std::string& text) const {
    const std::string wanted = naming::folded(text);
    const auto says = [&](const std::string& words) {
      return naming::folded(words).find(wanted) != std::string::npos;
    };
    std::string names;
    for (const AlarmDefinition& each : definitions_) {
      const bool found = says(each.text) || std::ranges::any_of(each.words, [&](const auto& language) {
                           return says(language.second.text);
                         });
      if (found) names += (names.empty() ? "\n" : "") + each.name + "\n";
    }
    return names;
  }

  storage::BatchQueue<Transition> queue;
  const std::filesystem::path path;

 private:
  // A commit begins as soon as there is something: what comes during one is the next.
  static constexpr std::size_t kEnough = 1;
  static constexpr std::size_t kMostInCommit = 5'000;

  result::Result<void> open() {
    auto file = JournalFile::open(path, definitions_, options_, views_);
    if (!file) return result::forward(file);
    file_.emplace(std::move(*file));
    return {};
  }

  void run() {
    std::vector<Transition> batch;
    while (queue.take(batch)) {
      waiting_.insert(waiting_.end(), std::make_move_iterator(batch.begin()),
                      std::make_move_iterator(batch.end()));
      step();
      queue.done();
    }
    step();  // what a file did not take that may take it now
  }

  // Whatever it throws is told as a failure.
  void step() {
    const auto thrown = result::thrown_by([this] { write(); });
    if (thrown)
      fail(result::fail(storage::kInputOutput, {path.string()}, "the journal cannot be written: " + *thrown)
               .value());
  }

  void write() {
    std::size_t written = 0;
    while (written < waiting_.size()) {
      const std::size_t count = std::min(waiting_.size() - written, kMostInCommit);
      if (auto done = write(std::span(waiting_).subspan(written, count)); !done) {
        waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(written));
        return fail(std::move(done.error()));
      }
      written += count;
      const std::lock_guard lock(mutex_);
      status_.written += count;
      status_.failing = false;
      status_.problems.clear();
    }
    waiting_.clear();
  }

  result::Result<void> write(std::span<const Transition> transitions) {
    if (!file_) {  // the damaged one is put aside, and no new one could be made yet
      if (auto opened = open(); !opened) return opened;
    }
    return file_->write(transitions);
  }

  void fail(result::Diagnostics problems) {
    const bool damaged = storage::is_damage(problems);
    const std::lock_guard lock(mutex_);
    if (damaged) {
      if (file_) views_ = file_->views();
      file_.reset();
      warnings_ = storage::put_aside_warnings(problems, storage::put_aside(path));
    }
    status_.failing = true;
    status_.problems = std::move(problems);
    if (waiting_.size() <= options_.most_waiting) return;
    const std::size_t excess = waiting_.size() - options_.most_waiting;
    status_.dropped += excess;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(excess));
  }

  const JournalOptions options_;
  const std::vector<AlarmDefinition> definitions_;
  std::optional<JournalFile> file_;  // this and the next two: of the writing thread
  LastViews views_;                  // of a file that is lost
  std::vector<Transition> waiting_;  // for a file that does not take them
  mutable std::mutex mutex_;
  JournalStatus status_;          // guarded by mutex_
  result::Diagnostics warnings_;  // guarded by mutex_
  std::thread thread_;            // last: it uses all of the above
};

AlarmJournal::AlarmJournal(std::unique_ptr<Core> core) : core_(std::move(core)) {}
AlarmJournal::~AlarmJournal() = default;

result::Result<std::unique_ptr<AlarmJournal>> AlarmJournal::open(const std::filesystem::path& file,
                                                                 std::vector<AlarmDefinition> definitions,
                                                                 JournalOptions options) {
  auto core = std::make_unique<Core>(file, std::move(definitions), options);
  if (auto started = core->start(); !started) return result::forward(started);
  return std::unique_ptr<AlarmJournal>(new AlarmJournal(std::move(core)));
}

void AlarmJournal::append(std::span<const Transition> transitions) {
  core_->queue.push(transitions);
}

result::Result<void> AlarmJournal::flush() {
  core_->queue.flush();
  JournalStatus status = core_->status();
  if (status.failing) return tl::unexpected<result::Diagnostics>(std::move(status.problems));
  return {};
}

result::Result<std::vector<JournalEntry>> AlarmJournal::find(const JournalQuery& query,
                                                             std::size_t most) const {
  auto view = JournalView::open(core_->path);
  if (!view) return result::forward(view);
  return view->find(query, query.text ? core_->names_with(*query.text) : std::string(), most);
}

result::Result<std::vector<AlarmJournal::Last>> AlarmJournal::last() const {
  auto view = JournalView::open(core_->path);
  if (!view) return result::forward(view);
  return view->last();
}

JournalStatus AlarmJournal::status() const {
  return core_->status();
}

result::Result<void> restore(AlarmEngine& engine, const AlarmJournal& journal) {
  auto last = journal.last();
  if (!last) return result::forward(last);
  for (const AlarmJournal::Last& one : *last)
    if (const auto alarm = engine.find(one.alarm)) engine.restore(*alarm, one.view);
  return {};
}

}  // namespace stepwright::alarms

#pragma once

// The alarms of a cell while it runs: every image's values into the engine, what happens into figures and
// journal, commands of people, and all of it as JSON for pages.
//
//   auto alarms = CellAlarms::open(folder / "alarms.db", definitions, options);
//   (*alarms)->take({time_ns, &observation, &view});        // every image
//   (*alarms)->command("runtime.lost", {.event = AlarmEvent::Acknowledge, .user = "anna"});
//
// A source of a definition is one of the cell's own (kRuntimeAlive ...), the id of a point of the picture
// ("a1.level"), or a variable of the program.
//
// Thread rule: everything from any thread; take from one. command() waits for the disk.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/alarms/engine.h"
#include "hmi_web/alarms/journal.h"
#include "hmi_web/alarms/statistics.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/server/cell_source.h"
#include "hmi_web/server/cell_viewer.h"
#include "hmi_web/server/value_texts.h"
#include "runtime/ground/result/result.h"

namespace stepwright::recorder {

inline constexpr std::string_view kRuntimeAlive = "cell.runtime_alive";
inline constexpr std::string_view kRuntimeFault = "cell.runtime_fault";
inline constexpr std::string_view kSupervisorAlive = "cell.supervisor_alive";
inline constexpr std::string_view kServerAway = "cell.server_away";

struct BuiltInAlarms {
  bool supervisor = false;     // the cell has one
  std::uint32_t monitors = 0;  // of a plan's program: MON_SCAN[1] ... (supervisor/doc/plan_to_sfc.md)
};

// Alarms of every cell: its processes, the limits of the picture's tanks, the plan's monitors.
std::vector<alarms::AlarmDefinition> built_in_alarms(const protocol::Synoptic& synoptic,
                                                     const BuiltInAlarms& wanted);

// The text of CellAlarms::json where there is no journal.
std::string no_alarms_json(const std::string& problem);

// One image, or that there is none.
struct RecordedScan {
  std::int64_t time_ns = 0;
  const server::Observation* observation = nullptr;
  const server::CellView* view = nullptr;
};

// Change of an alarm by a command: states as `json` names them.
struct AlarmChange {
  std::string before;
  std::string after;
};

// An alarm that stands, with what is known of it.
struct StandingView {
  alarms::AlarmDefinition definition;
  alarms::AlarmView view;
  server::ValueText told = {};  // its value as people read it
};

class CellAlarms {
 public:
  // Goes on where the journal's last process has ended. `points` as in every view. `seen_until_ns`: when the
  // process before this one looked last; 0: there was none. `notes`: what the cell says of its tags. Fails
  // with S0001 to S0008 and what AlarmEngine::create says.
  [[nodiscard]] static result::Result<std::unique_ptr<CellAlarms>> open(
      const std::filesystem::path& file, std::vector<alarms::AlarmDefinition> definitions,
      const std::vector<protocol::Point>& points, alarms::JournalOptions options,
      std::int64_t seen_until_ns = 0, std::vector<protocol::TagNote> notes = {});

  void take(const RecordedScan& scan);
  // The runtime answers (again) at that time, whatever time its first image has: what the clock leaves out
  // between two runs is no time in which it did not.
  void runtime_answers(std::int64_t time_ns);
  // `by.alarm` is found by the name, `by.time_ns` is now. Returns when it is in the journal. Fails with C0606
  // (refused), C0607 (there is no such alarm), S0001 to S0007 (it has happened, but is not in the file yet).
  [[nodiscard]] result::Result<AlarmChange> command(std::string_view alarm, alarms::Command by);

  // {"alarms": [...], "figures": {...}, "journal": {...}}; without `all` those that are normal are left out.
  // An alarm whose source says nothing is not normal: its state is "no value", of one whose variable the
  // program does not have, unless somebody has to acknowledge it, "no variable"; `problem` says why.
  std::string json(bool all) const;
  // Those that stand and that nobody has acknowledged.
  std::vector<StandingView> unacknowledged() const;
  // The value of an alarm's source as people read it, by the program whose image was seen last; empty: a
  // source of the cell's own, whose number says nothing.
  server::ValueText told(const std::string& source, double value) const;
  // Those whose variable the program does not have (any more): their names, and those of the variables.
  std::vector<std::pair<std::string, std::string>> without_variable() const;
  // Counts up whenever an alarm has changed.
  std::uint64_t revision() const;
  [[nodiscard]] result::Result<void> flush() { return journal_->flush(); }
  const alarms::AlarmJournal& journal() const { return *journal_; }
  const std::vector<alarms::AlarmDefinition>& definitions() const { return engine_.definitions(); }

 private:
  using Read = std::function<std::optional<double>(const RecordedScan&)>;
  // Why a source says nothing.
  enum class Missing : std::uint8_t {
    Nothing,   // it has a value
    Image,     // no runtime answers, or no image of its program has come
    Variable,  // the program has none of that name
    Device,    // the device of that input does not answer (yet)
    Value,     // the point of the picture has none
  };
  struct Source {
    std::string name;
    Read read;
    std::optional<reader::Variable> variable = {};  // of the program
    bool is_monitor = false;
    bool offered = false;
    std::optional<double> last;
    Missing missing = Missing::Image;
    bool has_no_variable = false;  // in the program whose image was seen last
  };

  CellAlarms(alarms::AlarmEngine engine, std::unique_ptr<alarms::AlarmJournal> journal,
             std::vector<protocol::Point> points, std::vector<protocol::TagNote> notes);
  result::Result<void> go_on();
  void note_absence(std::int64_t seen_until_ns);
  void offer_own(std::string_view source, std::int64_t time_ns, double value, bool time_known);
  Read reader_of(const std::string& source, const server::ProgramLayout* layout) const;
  void resolve(const std::shared_ptr<const server::ProgramLayout>& layout);
  std::int64_t time_of(const Source& source, double value, const RecordedScan& scan) const;
  void measure_interval(const RecordedScan& scan);
  std::optional<reader::Variable> variable_of(const std::string& source,
                                              const server::ProgramLayout* layout) const;
  static Missing missing_of(const Source& source, bool unread, bool has_value, const RecordedScan& scan);
  void note_missing(Source& source, Missing missing);
  const char* word_of(alarms::AlarmId alarm) const;
  std::string problem_of(alarms::AlarmId alarm) const;
  void hand_on();
  // Requires the lock.
  server::ValueText text_of(const std::string& source, double value) const;

  std::unique_ptr<alarms::AlarmJournal> journal_;
  std::vector<protocol::Point> points_;
  std::vector<protocol::TagNote> notes_;
  std::shared_ptr<const server::ProgramLayout> layout_;  // that `sources_` were resolved for
  bool resolved_ = false;
  std::vector<Source> sources_;  // by alarms::SourceId
  // Of each alarm; what suppresses it may be null.
  struct Use {
    const Source* watched = nullptr;
    const Source* suppressor = nullptr;
  };
  std::vector<Use> uses_;
  Read monitor_now_;  // the program's count of its scans
  // Of the image before: its time and that count, from which the scan's interval follows.
  std::int64_t before_ns_ = 0, before_count_ = 0, interval_ns_ = 0;

  mutable std::mutex mutex_;          // guards everything below
  mutable server::ValueTexts texts_;  // of `layout_`
  alarms::AlarmEngine engine_;
  mutable alarms::AlarmStatistics statistics_;
  std::int64_t now_ns_ = 0;
  std::uint64_t revision_ = 1;
};

}  // namespace stepwright::recorder

#pragma once

// The binding of a cell: what a planner's names mean at the terminals of a controller. It is the paper's
// "from/to table" (section "The Integration between Plan and PLC", Tables 1 to 5), written as a TOML file;
// supervisor/doc/binding_file.md describes every key.
//
// Immutable after reading; use from any thread.
// Invariants (read_binding proves them): every name that is used exists, tags do not overlap, outputs are
// BOOL, calibrations are strictly monotone, times are positive; with a vocabulary also: every action of the
// domain is bound, every atom exists with its arity.
//
//   auto binding = load_binding("tests/cells/bench/binding.toml", &vocabulary);
//   if (!binding) std::cerr << to_string(binding.error());
//   const Sensor* sensor = binding->sensor_of("(lev v1)");

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/vocabulary.h"
#include "supervisor/translate/calibration.h"
#include "supervisor/translate/pattern.h"

namespace stepwright::translate {

using std::chrono::milliseconds;

// A terminal of the controller.
struct Tag {
  std::string name;
  std::string type;     // "BOOL", or "INT", "UINT" of a sensor
  std::string address;  // "%IX0.0"
  std::string omron;    // the terminal on the paper's controller, "I0.00"; may be empty
  std::string comment;
  bool output = false;  // in the output area
  result::Location where{};
};

// Where a fluent can be read.
struct Sensor {
  std::string name;
  std::string tag;     // raw counts
  std::string fluent;  // "(lev v1)"
  std::string label;   // for people: "level of v1"
  Calibration calibration;
  double tolerance = 0.2;    // of expected states and guards, units of the fluent
  double resolution = 1.0;   // a planner sees multiples of this; 0 = as measured
  milliseconds filter{500};  // time constant of the filter in the program
  bool must_move = false;  // its raw counts are never the same for long while its level is moved: it is noisy
  bool tare = false;       // its bias is read before a run, where the level is known; else it is believed
  double max_bias_counts = 300.0;  // a larger bias means a broken sensor
  double max_drift = 0.3;          // that may add up unseen over a run (executive/drift_watch.h)
  double max_rate = 0.0;  // units of the fluent per second that the plant never exceeds; 0: not watched
  std::string unit;       // for people: "l"; may be empty
  std::optional<std::pair<double, double>> range;  // lowest and highest value that a goal may ask for
  std::string omron;  // memory word of the filtered counts (the paper's Table 3), "D100"
  result::Location where{};
};

// Where a fact can be read.
struct ObservedFact {
  std::string fact;  // "(is-at v1 f1)"
  std::string tag;
  bool inverted = false;  // true while the input is off
  std::string label;      // for people: "vehicle at f1"
};

// An attempt to bring back a fact of a OneOf group: drive `output` until one is true.
struct Search {
  std::string output;
  milliseconds timeout{0};
};

// Facts of which exactly one is true while no action is moving them: the places of a vehicle.
struct OneOf {
  std::vector<std::string> facts;
  std::vector<Search> searches;  // in order; may be empty
};

// Transfer of an amount from `from` (an observed fluent) to `to` (one without a sensor).
struct Transfer {
  Pattern from;
  Pattern to;
  double ratio = 1.0;
};

// How long an action takes: fixed + per_unit x |change of `of`| in seconds. A fluent that the action does not
// change (a distance) counts with its value.
struct DurationModel {
  double fixed_s = 0.0;
  double per_unit_s = 0.0;
  std::optional<Pattern> of;
};

enum class CompletionKind : std::uint8_t { Fact, Fluent };

// When an action is done: a fact is observed, or a fluent reaches its value after the action. The direction
// follows from the values before and after.
struct Completion {
  CompletionKind kind = CompletionKind::Fact;
  Pattern atom;
  double pre_act = 0.0;  // Fluent: stop this much early, for run-out and filter lag; units of the fluent
};

// How the controller executes the actions that match a pattern.
struct ActionBinding {
  Pattern pattern;
  std::vector<std::string> outputs;  // driven while the step is active
  bool names_outputs = false;        // the entry has them, and be it an empty list: it waits for others
  Completion completion;
  std::vector<Pattern> hold;  // facts that must stay true while it runs; else it is stopped and has failed
  milliseconds timeout{0};
  milliseconds rest{0};  // outputs off after completion, so that what runs out arrives and filters follow
  std::vector<Transfer> transfers;
  DurationModel duration;
  result::Location where;
};

// A device, which fails as a whole: the actions that drive its outputs, and those that need it without
// driving it. An output that no entry names is a device of its own, with the name of its tag.
struct Device {
  std::string name;  // for people: "diverter 1"
  std::vector<std::string> outputs;
  std::vector<Pattern> actions;
};

struct Binding {
  std::string file;
  milliseconds start{0};   // before the initial snapshot is checked (filters settle)
  milliseconds settle{0};  // after the last action, before DONE
  std::vector<Tag> tags;   // in file order, as everything below
  std::vector<Sensor> sensors;
  std::vector<ObservedFact> facts;
  std::vector<OneOf> one_of;
  std::vector<std::vector<std::string>> exclusive;  // outputs of which one at most is ever on
  std::vector<ActionBinding> actions;
  std::vector<Device> devices;
  // Facts and fluents that no sensor shows and that are taken to be as actions leave them.
  std::vector<Pattern> believed;

  const Tag* tag(std::string_view name) const;
  const Sensor* sensor_of(std::string_view fluent) const;
  const ObservedFact* observed(std::string_view fact) const;
  // The first entry that matches, and what its pattern binds; null and empty if none does.
  const ActionBinding* action_for(const model::GroundAction& action, Assignment& assignment) const;
  // The names of the devices without which an action cannot be executed, in file order.
  std::vector<std::string> devices_of(const model::GroundAction& action) const;
};

// Reads a binding; `vocabulary` (may be null) is the planning domain to check names against. Every problem
// is reported at once, each with file, line and column: B0001 to B0006 as TomlDocument says (syntax, unknown
// key, type, range, missing key, rejected value), B0007 a name that nothing declares, B0008 addresses that
// overlap, B0009 an action of the domain without entry.
[[nodiscard]] result::Result<Binding> read_binding(std::string_view text, std::string file,
                                                   const model::Vocabulary* vocabulary = nullptr);
[[nodiscard]] result::Result<Binding> load_binding(const std::filesystem::path& file,
                                                   const model::Vocabulary* vocabulary = nullptr);

// Steps of the generated programs: "SEARCH_1_2" is the second search of the first OneOf group (both from 0).
std::string search_step(std::size_t group, std::size_t search);
// Variables of the generated programs: "S1_filtered" holds a sensor's filtered counts, "S1_half" their mean
// over the first half of a window of averaging.
std::string filtered_variable(const Sensor& sensor);
std::string half_variable(const Sensor& sensor);

}  // namespace stepwright::translate

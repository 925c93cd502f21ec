#include <array>

#include "cell/reference/described_file.h"

namespace stepwright::reference {
namespace {

using settings::KeyWords;

constexpr std::string_view kOfFluent = "that of the fluent";
constexpr std::string_view kOutputs = "Outputs, by the names of their tags.";

constexpr std::array kBindingKeys = {
    KeyWords{
        "believed",
        "Facts and fluents that no sensor shows, as patterns: `\"(at ?i ?p)\"`; they are as actions leave "
        "them."},

    KeyWords{"times", "Waits around a plan."},
    KeyWords{"times.start_s", "Before the initial state is checked: several filter times."},
    KeyWords{"times.settle_s", "Rest after the last action, before the plan is done."},

    KeyWords{"tags", "The terminals, by the names of the variables that they become."},
    KeyWords{"tags.NAME", "One terminal."},
    KeyWords{"tags.NAME.address", "`%IX0.0`, `%IW1`, `%QX0.0`; `%IW1` is bytes 2 and 3."},
    KeyWords{"tags.NAME.type", "An elementary type; `INT` or `UINT` of counts."},
    KeyWords{"tags.NAME.omron", "The terminal on an Omron CJ: `I0.00`, `Q1.02`, an analog word `2001`."},
    KeyWords{"tags.NAME.comment", "Shown in drawings and tables of addresses."},

    KeyWords{"sensors", "What measures a fluent of the planner."},
    KeyWords{"sensors.NAME", "One sensor."},
    KeyWords{"sensors.NAME.tag", "The INT or UINT input that has its counts."},
    KeyWords{"sensors.NAME.fluent", "The ground fluent that it measures: `(level a1)`."},
    KeyWords{"sensors.NAME.calibration", "`[[value, counts], ...]`, two points at least, strictly monotone.",
             "", "needed"},
    KeyWords{"sensors.NAME.label", "For sentences: \"level of a1\".", "", "from the fluent"},
    KeyWords{"sensors.NAME.tolerance", "Of guards, of the initial state and of expected states.", kOfFluent},
    KeyWords{"sensors.NAME.resolution", "A planner sees multiples of this; 0: as measured.", kOfFluent},
    KeyWords{"sensors.NAME.filter_s", "Time constant of the low-pass filter."},
    KeyWords{"sensors.NAME.must_move",
             "Counts that stay the same for 2 s while an action moves the level mean "
             "that the sensor has failed."},
    KeyWords{"sensors.NAME.tare", "Before a run its mean counts at the level of `:init` are its bias."},
    KeyWords{"sensors.NAME.max_bias_counts", "With `tare`: a bias beyond this is a broken sensor.", "counts"},
    KeyWords{"sensors.NAME.max_drift",
             "A reading that has walked away by more, a little at a time, stops the run.", kOfFluent,
             "1.5 x `tolerance`", "at least `tolerance`"},
    KeyWords{"sensors.NAME.max_rate",
             "A reading that changes faster is a failed sensor, found in the scan; 0: not watched.",
             "units of the fluent in a second"},
    KeyWords{"sensors.NAME.unit", "For people, in forms."},
    KeyWords{"sensors.NAME.range", "`[lowest, highest]` that a goal may ask for.", kOfFluent, "any"},
    KeyWords{"sensors.NAME.omron", "The memory word of the filtered counts on an Omron CJ: `D100`."},

    KeyWords{"facts", "A fact that a switch shows."},
    KeyWords{"facts.fact", "The ground fact: `(is-at v1 f1)`."},
    KeyWords{"facts.tag", "The BOOL input that shows it."},
    KeyWords{"facts.inverted", "The fact is true while the input is off."},
    KeyWords{"facts.label", "For sentences.", "", "the fact"},

    KeyWords{"one_of", "Facts of which exactly one is true, unless an action is moving them."},
    KeyWords{"one_of.facts", "The facts, two at least.", "", "needed"},
    KeyWords{"one_of.search", "How to bring one back when none is observed, in this order."},
    KeyWords{"one_of.search.output", "The output that is on while it is looked for."},
    KeyWords{"one_of.search.timeout_s", "When it is given up."},

    KeyWords{"exclusive",
             "Outputs that are never on together: actions that drive two run one after the other."},
    KeyWords{"exclusive.outputs", "Two or more, by the names of their tags.", "", "needed"},

    KeyWords{"actions", "How an action is carried out; the first entry that matches is used."},
    KeyWords{"actions.action", "A pattern: `(move ?v ?from ?to)`."},
    KeyWords{"actions.outputs", "On while the action runs. Outputs, by the names of their tags."},
    KeyWords{"actions.timeout_s", "Longer means failed."},
    KeyWords{"actions.rest_s", "Outputs off after completion, until what runs out has arrived."},
    KeyWords{"actions.hold", "Facts without which it is stopped at once, and has failed."},

    KeyWords{"actions.until", "What completes it: one fact, or one fluent."},
    KeyWords{"actions.until.fact", "The fact that ends it."},
    KeyWords{"actions.until.fluent", "The fluent that must reach its value after the action."},
    KeyWords{"actions.until.pre_act", "Switches off so much early, for what runs out.", kOfFluent},

    KeyWords{"actions.transfers", "What leaves one fluent arrives in another one, which no sensor sees."},
    KeyWords{"actions.transfers.from", "The measured fluent."},
    KeyWords{"actions.transfers.to", "The other one."},
    KeyWords{"actions.transfers.ratio", "What arrives of one that leaves."},

    KeyWords{"actions.duration", "Nominal duration, for schedules: fixed, and by what the action changes."},
    KeyWords{"actions.duration.fixed_s", "In any case."},
    KeyWords{"actions.duration.per_unit_s", "For each unit of `of`."},
    KeyWords{"actions.duration.of", "The fluent whose change is counted."},

    KeyWords{"devices", "What can fail as one."},
    KeyWords{"devices.name", "As reports call it: \"diverter 1\"."},
    KeyWords{"devices.outputs", kOutputs},
    KeyWords{"devices.actions", "Patterns of actions that need it without driving it."},
};

}  // namespace

std::span<const KeyWords> binding_keys() {
  return kBindingKeys;
}

}  // namespace stepwright::reference

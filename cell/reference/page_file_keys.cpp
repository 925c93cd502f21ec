#include <array>

#include "cell/reference/described_file.h"

namespace stepwright::reference {
namespace {

using settings::KeyWords;

constexpr std::string_view kAsAbove = "as in the alarm itself";

constexpr std::array kAlarmKeys = {
    KeyWords{"alarm", "One alarm; a file has as many as are wanted."},
    KeyWords{"alarm.name", "Its name, which no other alarm has."},
    KeyWords{"alarm.source", "The variable that is watched, as the program calls it."},
    KeyWords{"alarm.when",
             "It is raised above `limit`, below it, while the variable is not 0, while it is 0, or "
             "while its value is missing."},
    KeyWords{"alarm.limit", "Of `high` and `low`, which need one. Of a TIME in seconds, or as `\"T#1m30s\"`.",
             "that of the variable"},
    KeyWords{"alarm.deadband", "It returns so far beyond the limit.", "that of the variable", "",
             "at least 0"},
    KeyWords{"alarm.on_delay_s", "So long the condition holds before it counts."},
    KeyWords{"alarm.off_delay_s", "So long the condition is gone before that counts."},
    KeyWords{"alarm.priority", "How soon somebody has to act."},
    KeyWords{"alarm.latching", "It stays until it is reset."},
    KeyWords{"alarm.acknowledge", "By an operator, or by the return of the condition."},
    KeyWords{"alarm.group", "Alarms of a group tell which of them came first."},
    KeyWords{"alarm.suppress_when", "A variable: suppressed by design while it is not 0."},
    KeyWords{"alarm.suppress_by_hand",
             "People may suppress it, with a reason and without an end; not beside `suppress_when`."},
    KeyWords{"alarm.shelve_at_most_min", "The longest shelving; 0: never."},
    KeyWords{"alarm.text", "What people read.", "", "the name"},
    KeyWords{"alarm.consequence", "What happens if nobody acts."},
    KeyWords{"alarm.response", "What is to be done."},

    KeyWords{"alarm.de", "Its texts in German."},
    KeyWords{"alarm.de.text", "What people read.", "", kAsAbove},
    KeyWords{"alarm.de.consequence", "What happens if nobody acts.", "", kAsAbove},
    KeyWords{"alarm.de.response", "What is to be done.", "", kAsAbove},
    KeyWords{"alarm.en", "Its texts in English."},
    KeyWords{"alarm.en.text", "What people read.", "", kAsAbove},
    KeyWords{"alarm.en.consequence", "What happens if nobody acts.", "", kAsAbove},
    KeyWords{"alarm.en.response", "What is to be done.", "", kAsAbove},
    KeyWords{"alarm.es", "Its texts in Spanish."},
    KeyWords{"alarm.es.text", "What people read.", "", kAsAbove},
    KeyWords{"alarm.es.consequence", "What happens if nobody acts.", "", kAsAbove},
    KeyWords{"alarm.es.response", "What is to be done.", "", kAsAbove},
    KeyWords{"alarm.fr", "Its texts in French."},
    KeyWords{"alarm.fr.text", "What people read.", "", kAsAbove},
    KeyWords{"alarm.fr.consequence", "What happens if nobody acts.", "", kAsAbove},
    KeyWords{"alarm.fr.response", "What is to be done.", "", kAsAbove},
};

constexpr std::array kRecipeKeys = {
    KeyWords{"tag", "One variable that recipes set; 1 to 128 of them."},
    KeyWords{"tag.name", "The path of the variable, or its address (`%MW4`), as the program spells it."},
    KeyWords{"tag.type", "Its type in the program."},
    KeyWords{"tag.min", "The least value; a BOOL and a text have none.", "that of `unit`; of a TIME s"},
    KeyWords{"tag.max", "The greatest value; a BOOL and a text have none.", "that of `unit`; of a TIME s"},
    KeyWords{"tag.unit", "For people; a BOOL and a text have none.", "",
             "`s` of a TIME, else that of the tag"},
    KeyWords{"tag.comment", "What it is, for people."},
};

}  // namespace

std::span<const KeyWords> alarm_keys() {
  return kAlarmKeys;
}
std::span<const KeyWords> recipe_keys() {
  return kRecipeKeys;
}

}  // namespace stepwright::reference

#pragma once

// Numbers that were kept of tags and points, as people read them where no page writes them: in mails and in
// the tables of the journal.
//
//   const ValueTexts texts(notes_of_the_cell, points, layout.get());
//   texts.of("Main.level", 95).text;    // "95.00 l"
//
// What the cell says of a tag comes before what its declaration says, key by key (hmi_web/doc/tags.md).
// It keeps what it has found of a name. One thread at a time; lives no longer than the layout.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/protocol/tag_note.h"
#include "hmi_web/server/program_layout.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::server {

// "4 ms", "5 us", "2.50 s", "1 min 30 s", "2 h 5 min", "100 d 4 h": of a duration in seconds; "-" before a
// negative one, "0 s" for what is less than half a nanosecond.
std::string duration_text(double seconds);

struct ValueText {
  std::string text;  // "95.00 l", "Auto", "TRUE", "4 ms"
  std::string unit;  // of the number: "l", of a TIME "s"; empty: it has none
  bool is_bool = false;
};

class ValueTexts {
 public:
  // `layout`: null where no program is known.
  ValueTexts(std::vector<protocol::TagNote> notes, const std::vector<protocol::Point>& points,
             const ProgramLayout* layout);

  // `name`: of a tag of the program, or the id of a point. A name that nobody knows has the number alone.
  ValueText of(const std::string& name, double value);

 private:
  // What is said of a name, the cell's words first.
  struct Known {
    std::string unit;
    std::optional<int> decimals;
    std::vector<std::string> values;
    std::optional<bytecode::ElementaryType> type;  // of a tag of the program
    const protocol::Enumeration* enumeration = nullptr;

    void add(const protocol::TagNote& note);
    std::optional<std::string> name_of(double value) const;
    std::string digits_of(double value) const;
  };
  Known known(std::string_view name) const;
  const protocol::TagNote* note_of(const std::string& folded) const;

  std::vector<protocol::TagNote> notes_;
  std::map<std::string, std::size_t> by_name_;  // of notes_, by the folded name
  std::map<std::string, std::string> points_;   // units by id
  std::map<std::string, Known> found_;          // by the name that was asked for
  const ProgramLayout* layout_;
};

}  // namespace stepwright::server

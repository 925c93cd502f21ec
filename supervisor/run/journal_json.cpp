#include "supervisor/run/internal/journal_json.h"

namespace stepwright::run::internal {

result::Result<void> write_journal(const std::filesystem::path& file, const JournalForm& form,
                                   const Journal& journal, json own) {
  own["version"] = form.version;
  own["record"] = record_json(journal.record);
  own["next_request"] = journal.next_request;
  own["time_s"] = journal.clock.now_s;
  own["time_offset_s"] = journal.clock.offset_s;
  own["incarnation"] = journal.clock.incarnation;
  return replace_journal_file(file, text_of(own));
}

void journal_from(const json& document, Journal& journal) {
  journal.record = record_from(document.at("record"));
  // Journals of earlier versions have another name for it, and no incarnation.
  const char* const next = document.contains("next_request") ? "next_request" : "next_change";
  journal.next_request = document.at(next);
  journal.clock = {document.at("time_s"), document.at("time_offset_s"),
                   document.value("incarnation", std::uint64_t{0})};
}

}  // namespace stepwright::run::internal

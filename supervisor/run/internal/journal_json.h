#pragma once

// A mission's journal on the disk: one JSON object with what all of them keep and the mission's own keys
// beside it. It is replaced as a whole, and not trusted when it is read.
//
//   write_journal(file, kForm, journal, {{"plan", plan_json(journal.plan)}});
//   read_journal<Journal>(file, kForm, [](const json& document, Journal& journal) -> const char* {
//     journal.plan = plan_from(document.at("plan"));
//     return fits(journal) ? nullptr : "its plan does not fit its record";
//   });
//
// Threads: any; both functions wait for the disk.

#include <filesystem>
#include <optional>

#include "supervisor/run/internal/record_json.h"
#include "supervisor/run/journal.h"
#include "supervisor/run/journal_file.h"

namespace stepwright::run::internal {

struct JournalForm {
  const char* what;  // "journal"
  int version;
};

// Returns once it is on the disk; fails with X0004.
[[nodiscard]] result::Result<void> write_journal(const std::filesystem::path& file, const JournalForm& form,
                                                 const Journal& journal, json own);
// Throws json::exception where the shape differs.
void journal_from(const json& document, Journal& journal);

// Nothing if there is no file; X0001 if there is one that is no such journal; X0004 if it cannot be read.
// `read(document, journal)` reads the mission's own: why it is refused, or null.
template <typename Kept, typename Read>
result::Result<std::optional<Kept>> read_journal(const std::filesystem::path& file, const JournalForm& form,
                                                 const Read& read) {
  auto text = read_journal_file(file);
  if (!text) return result::forward(text);
  if (!*text) return std::optional<Kept>();
  const auto kept = [&](const json& document) -> result::Result<std::optional<Kept>> {
    Kept journal;
    const char* wrong = "of another version";
    if (document.at("version") == form.version) {
      journal_from(document, journal);
      wrong = read(document, journal);
    }
    if (wrong == nullptr) return std::optional<Kept>(std::move(journal));
    return result::fail("X0001", {file.string(), 0, 0}, std::string("not a ") + form.what + ": " + wrong,
                        "delete the file to start afresh");
  };
  return read_text(**text, file.string(), form.what, kept);
}

}  // namespace stepwright::run::internal

#pragma once

// Reading a TOML file whose author makes mistakes: every value is fetched by key with its type and range,
// every problem is collected with file, line, column, and keys that nobody asked for are reported with the
// name that was probably meant.
//
//   auto document = TomlDocument::load("cell.toml");            // syntax errors end here
//   TomlTable clock = document->root().table("clock");
//   double speed = clock.number("speed", 0.0, {0.0, 1e6});      // default where the key is missing
//   Diagnostics problems = document->finish();                  // all problems, unknown keys included
//
// Not thread-safe; a TomlTable lives no longer than its document.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/asked_key.h"

namespace stepwright::settings {

// One value of a document as text, to tell whether a file says something else than before.
struct SettingText {
  std::string text;
  result::Location where;
};
// By dotted key: "plant.seed", "faults[0].name".
using SettingTexts = std::map<std::string, SettingText>;

class TomlDocument;

// One table of a document; may stand for a missing one, in which case every value takes its default.
class TomlTable {
 public:
  bool has(std::string_view key) const;
  // The key has a table: where a short form and a long one are possible.
  bool has_table(std::string_view key) const;
  // The key has a text: where a number may stand with its unit in quotes or alone.
  bool is_text(std::string_view key) const;

  // Optional values: the default where the key is missing, a diagnostic and the default where it is wrong.
  std::string text(std::string_view key, std::string fallback) const;
  double number(std::string_view key, double fallback, Range range = {}) const;
  std::int64_t integer(std::string_view key, std::int64_t fallback, Range range = {}) const;
  bool boolean(std::string_view key, bool fallback) const;
  // One of `choices`; the first is not special.
  std::string choice(std::string_view key, std::string fallback,
                     const std::vector<std::string>& choices) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<double> numbers(std::string_view key) const;
  // An array of number arrays, each of `width` values: calibration points and the like.
  std::vector<std::vector<double>> number_rows(std::string_view key, std::size_t width) const;

  // Required values: a diagnostic where the key is missing, and where its text is empty, under a code of the
  // caller's own if it has one.
  std::string required_text(std::string_view key, const char* empty_number = "0006") const;
  double required_number(std::string_view key, Range range = {}) const;

  TomlTable table(std::string_view key) const;                // missing: an empty table
  std::vector<TomlTable> tables(std::string_view key) const;  // [[key]]; missing: none
  // No key of this table is reported as unknown: where it cannot be known which ones it may have.
  void accept_all() const;
  // The keys of this table in file order; asking marks none of them as known.
  std::vector<std::string> keys() const;

  // Where a key's value (or, without it, the table) stands in the file.
  result::Location where(std::string_view key = {}) const;
  // Reports a problem that only the caller can see, at the key's place, under a code of its own if it has
  // one.
  void report(std::string_view key, std::string message, std::string hint = {},
              const char* number = "0006") const;

 private:
  friend class TomlDocument;
  TomlTable(TomlDocument* document, const void* node, std::string path);
  const void* find(std::string_view key) const;
  void tell(std::string_view key, AskedKey asked) const;
  void wrong_type(std::string_view key, const char* expected) const;
  double ranged(std::string_view key, double value, Range range, double fallback) const;

  TomlDocument* document_;
  const void* node_;  // toml::table, or null for a missing one
  std::string path_;  // dotted, "" for the root
};

class TomlDocument {
 public:
  // `code` starts every diagnostic of this document ("C" configuration, "B" binding): C0001 syntax, C0002
  // unknown key, C0003 wrong type, C0004 out of range, C0005 missing key, C0006 rejected value.
  [[nodiscard]] static result::Result<std::unique_ptr<TomlDocument>> load(const std::filesystem::path& file,
                                                                          std::string code = "C");
  [[nodiscard]] static result::Result<std::unique_ptr<TomlDocument>> parse(std::string_view text,
                                                                           std::string file,
                                                                           std::string code = "C");
  ~TomlDocument();

  // Sets a dotted key ("plant.seed") to a TOML value text ("7"; bare words are taken as strings), before
  // values are read. An inline table changes the keys that it names and leaves the others.
  [[nodiscard]] result::Result<void> override_value(const std::string& dotted_key, const std::string& value);

  // From now on `listener` is told of every key that a reader asks for, also where the file does not have it.
  void listen(KeyListener listener);

  TomlTable root();
  // Every value that the document holds, overrides included.
  SettingTexts values() const;
  // Every problem so far, and every key that was never asked for. Call it last. `advice` is asked about a key
  // that is like none of its table.
  result::Diagnostics finish(const KeyAdvice& advice = {});

 private:
  friend class TomlTable;
  struct State;
  TomlDocument();
  std::unique_ptr<State> state_;
};

// The candidate closest to `word` if it is close enough to be a slip, else "".
std::string closest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace stepwright::settings

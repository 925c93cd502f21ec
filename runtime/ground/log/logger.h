#pragma once

// Log of a process: lines for people or JSON objects for machines, on standard error or in a file, limited in
// number per kind.
//
//   auto log = log::Logger::open("runtime", config.log);
//   (*log)->info("listens", "runtime 'bench' listens on /run/bench.sock", {{"socket", "/run/bench.sock"}});
//   (*log)->tick();                    // now and then, so that counts of suppressed lines come out
//
// A message is a sentence that says everything; the fields repeat its values for machines and appear in JSON
// only. The kind is a short constant word: it is what the limit counts by and what one filters by.
//
// Threads: any, except that of the scan, which never logs. Nothing here fails a caller or keeps it
// (line_writer.h): a file that can no longer be written (a full disk) and a reader that is gone or does not
// read cost lines; standard error says so once a second, or the log itself how many were lost. C0463: the
// file cannot be opened.

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "runtime/ground/log/log_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::log {

struct Field {
  std::string_view name;
  std::variant<std::string, std::int64_t, std::uint64_t, double, bool> value;

  Field(std::string_view n, std::string v) : name(n), value(std::move(v)) {}
  Field(std::string_view n, const char* v) : name(n), value(std::string(v)) {}
  Field(std::string_view n, std::int64_t v) : name(n), value(v) {}
  Field(std::string_view n, std::uint64_t v) : name(n), value(v) {}
  Field(std::string_view n, std::uint32_t v) : name(n), value(std::uint64_t{v}) {}
  Field(std::string_view n, int v) : name(n), value(std::int64_t{v}) {}
  Field(std::string_view n, double v) : name(n), value(v) {}
  Field(std::string_view n, bool v) : name(n), value(v) {}
};

using Fields = std::initializer_list<Field>;

class Logger {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<Logger>> open(std::string process,
                                                                    const LogConfig& config);
  // Says what is still suppressed.
  ~Logger();

  // Takes another configuration from the next line on, and opens the file again (it may have been moved
  // away). An error leaves everything as it was.
  [[nodiscard]] result::Result<void> reopen(const LogConfig& config);

  void debug(std::string_view kind, const std::string& message, Fields fields = {});
  void info(std::string_view kind, const std::string& message, Fields fields = {});
  void warning(std::string_view kind, const std::string& message, Fields fields = {});
  void error(std::string_view kind, const std::string& message, Fields fields = {});

  // Says how many lines of the seconds that are over were suppressed.
  void tick();

 private:
  struct State;
  explicit Logger(std::unique_ptr<State> state);
  void write(LogLevel level, std::string_view kind, const std::string& message, Fields fields);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::log

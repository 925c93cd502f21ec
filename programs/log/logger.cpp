#include "programs/log/logger.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <mutex>
#include <utility>

#include "programs/log/line.h"
#include "programs/log/rate_limit.h"

namespace stepwright::log {
namespace {

// spdlog brings the sinks and survives their errors; what a line looks like is ours.
using Sink = std::shared_ptr<spdlog::logger>;

result::Result<Sink> make_sink(const std::string& process, const config::LogConfig& config) {
  try {
    spdlog::sink_ptr sink;
    if (config.file.empty()) {
      sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
    } else {
      sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(config.file.string());
    }
    auto logger = std::make_shared<spdlog::logger>(process, std::move(sink));
    logger->set_pattern("%v");
    logger->set_level(spdlog::level::trace);
    logger->flush_on(spdlog::level::trace);  // a line that explains a crash must not be lost in it
    return logger;
  } catch (const spdlog::spdlog_ex& problem) {
    result::Location where = config.where;
    if (where.file.empty()) where.file = config.file.string();
    return result::fail("C0463", where, std::string("the log cannot be opened: ") + problem.what(),
                        "name a file in a folder that this user may write to, or leave [log] file out");
  }
}

}  // namespace

struct Logger::State {
  State(std::string p, const config::LogConfig& c, Sink s)
      : process(std::move(p)), config(c), sink(std::move(s)), limit(c.limit_per_s) {}

  void put(const Message& message, Fields fields) const {
    sink->info(spdlog::string_view_t(config.format == config::LogFormat::Json ? json_line(message, fields)
                                                                              : text_line(message)));
  }
  void tell(const std::vector<Suppressed>& list) const {
    for (const Suppressed& each : list) {
      const std::string text =
          std::to_string(each.count) + " more messages of kind '" + each.kind + "' were suppressed";
      put({std::chrono::system_clock::now(), LogLevel::Warning, process, "suppressed", text},
          {{"of", each.kind}, {"count", each.count}});
    }
  }

  std::mutex mutex;
  std::string process;
  config::LogConfig config;
  Sink sink;
  RateLimit limit;
};

Logger::Logger(std::unique_ptr<State> state) : state_(std::move(state)) {}

Logger::~Logger() {
  const std::scoped_lock lock(state_->mutex);
  state_->tell(state_->limit.rest());
}

result::Result<std::unique_ptr<Logger>> Logger::open(std::string process, const config::LogConfig& config) {
  auto sink = make_sink(process, config);
  if (!sink) return result::forward(sink);
  return std::unique_ptr<Logger>(
      new Logger(std::make_unique<State>(std::move(process), config, std::move(*sink))));
}

result::Result<void> Logger::reopen(const config::LogConfig& config) {
  auto sink = make_sink(state_->process, config);
  if (!sink) return result::forward(sink);
  const std::scoped_lock lock(state_->mutex);
  state_->config = config;
  state_->sink = std::move(*sink);
  state_->limit.set_limit(config.limit_per_s);
  return {};
}

void Logger::write(LogLevel level, std::string_view kind, const std::string& message, Fields fields) {
  const auto now = RateLimit::Clock::now();
  const std::scoped_lock lock(state_->mutex);
  if (level < state_->config.level) return;
  state_->tell(state_->limit.due(now));
  if (!state_->limit.admit(kind, now)) return;
  state_->put({std::chrono::system_clock::now(), level, state_->process, kind, message}, fields);
}

void Logger::debug(std::string_view kind, const std::string& message, Fields fields) {
  write(LogLevel::Debug, kind, message, fields);
}
void Logger::info(std::string_view kind, const std::string& message, Fields fields) {
  write(LogLevel::Info, kind, message, fields);
}
void Logger::warning(std::string_view kind, const std::string& message, Fields fields) {
  write(LogLevel::Warning, kind, message, fields);
}
void Logger::error(std::string_view kind, const std::string& message, Fields fields) {
  write(LogLevel::Error, kind, message, fields);
}

void Logger::tick() {
  const std::scoped_lock lock(state_->mutex);
  state_->tell(state_->limit.due(RateLimit::Clock::now()));
}

}  // namespace stepwright::log

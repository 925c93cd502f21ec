#include "runtime/ground/log/logger.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <mutex>
#include <utility>

#include "runtime/ground/log/line.h"
#include "runtime/ground/log/line_writer.h"
#include "runtime/ground/log/rate_limit.h"
#include "runtime/ground/log/rotating_file.h"
#include "runtime/ground/result/counted.h"

namespace stepwright::log {
namespace {

bool takes_more(int descriptor) {
  pollfd entry{descriptor, POLLOUT, 0};
  return poll(&entry, 1, 0) == 1;
}

// The file of a log as spdlog wants it, which survives its errors.
class FileSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit FileSink(std::unique_ptr<RotatingFile> file) : file_(std::move(file)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    if (const int error = file_->append({line.data(), line.size()}); error != 0)
      throw spdlog::spdlog_ex("the log cannot be written", error);
  }
  void flush_() override {}

  std::unique_ptr<RotatingFile> file_;
};

// A link in a folder into which everybody may write may be anybody's and lead anywhere.
bool may_mislead(const std::filesystem::path& file) {
  struct stat link {};
  struct stat folder {};
  if (lstat(file.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return false;
  const std::filesystem::path parent = file.has_parent_path() ? file.parent_path() : ".";
  return stat(parent.c_str(), &folder) == 0 && (folder.st_mode & S_IWOTH) != 0;
}

// spdlog brings the sinks and survives their errors; what a line looks like is ours.
result::Result<LineTarget> make_target(const std::string& process, const LogConfig& config) {
  const auto refuse = [&](const std::string& why) {
    result::Location where = config.where;
    if (where.file.empty()) where.file = config.file.string();
    return result::fail("C0463", where, "the log cannot be opened: " + why,
                        "name a file in a folder that this user may write to, or leave [log] file out");
  };
  if (may_mislead(config.file)) return refuse("it is a link in a folder into which everybody may write");
  try {
    spdlog::sink_ptr sink;
    if (config.file.empty()) {
      sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
    } else {
      auto file = RotatingFile::open(config.file, {std::uint64_t{config.max_mb} << 20, config.keep});
      if (!file) return refuse(std::strerror(file.error()));
      sink = std::make_shared<FileSink>(std::move(*file));
    }
    auto logger = std::make_shared<spdlog::logger>(process, std::move(sink));
    logger->set_pattern("%v");
    logger->set_level(spdlog::level::trace);
    logger->flush_on(spdlog::level::trace);  // a line that explains a crash must not be lost in it
    LineTarget target;
    target.write = [logger](const std::string& line) { logger->info(spdlog::string_view_t(line)); };
    if (config.file.empty()) target.ready = [] { return takes_more(STDERR_FILENO); };
    return target;
  } catch (const spdlog::spdlog_ex& problem) {
    return refuse(problem.what());
  }
}

}  // namespace

struct Logger::State {
  State(std::string p, const LogConfig& c, LineTarget target)
      : process(std::move(p)), config(c), limit(c.limit_per_s) {
    writer.set_target(std::move(target));
  }

  void put(const Message& message, Fields fields) {
    writer.put(config.format == LogFormat::Json ? json_line(message, fields) : text_line(message));
  }
  void tell(const std::vector<Suppressed>& list) {
    if (const std::uint64_t lost = writer.take_lost(); lost > 0) {
      const std::string text = result::counted(lost, "line was", "lines were") +
                               " lost: the log is not written as fast as it grows";
      put({std::chrono::system_clock::now(), LogLevel::Warning, process, "lost_lines", text},
          {{"count", lost}});
    }
    for (const Suppressed& each : list) {
      const std::string text =
          std::to_string(each.count) + " more messages of kind '" + each.kind + "' were suppressed";
      put({std::chrono::system_clock::now(), LogLevel::Warning, process, "suppressed", text},
          {{"of", each.kind}, {"count", each.count}});
    }
  }

  std::mutex mutex;
  std::string process;
  LogConfig config;
  RateLimit limit;
  LineWriter writer;
};

Logger::Logger(std::unique_ptr<State> state) : state_(std::move(state)) {}

Logger::~Logger() {
  const std::scoped_lock lock(state_->mutex);
  state_->tell(state_->limit.rest());
}

result::Result<std::unique_ptr<Logger>> Logger::open(std::string process, const LogConfig& config) {
  auto target = make_target(process, config);
  if (!target) return result::forward(target);
  return std::unique_ptr<Logger>(
      new Logger(std::make_unique<State>(std::move(process), config, std::move(*target))));
}

result::Result<void> Logger::reopen(const LogConfig& config) {
  auto target = make_target(state_->process, config);
  if (!target) return result::forward(target);
  const std::scoped_lock lock(state_->mutex);
  state_->config = config;
  state_->writer.set_target(std::move(*target));
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

// The historian beside a row of SQLite for every sample, in transactions as large, and beside lines of CSV:
// how many samples a second, how many bytes each, and how long the extremes of 2,000 columns over 30 days
// take. Then alarms (alarms.h).
//
//   bench_historian [--samples N] [--tags N] [--days D] [--rate HZ] [--columns N] [--changes N]
//                   [--alarm-seconds S] [--folder DIR] [--json FILE]
//
// Everything is handed over by one thread. Results that differ end the program: exit code 5.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "hmi_web/historian/historian.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/historian/alarms.h"
#include "tests/bench/historian/baselines.h"
#include "tests/bench/historian/signals.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::bench {
namespace {

using historian::Historian;
using historian::Sample;
using historian::TagId;
using historian::TagSample;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::size_t kBatch = 100'000;
constexpr int kQueries = 15;

struct Arguments {
  std::size_t samples = 2'000'000;
  std::uint32_t tags = 100;
  double days = 30.0;
  double rate_hz = 1.0;
  std::size_t columns = 2'000;
  AlarmLoad alarms;
  std::string folder = std::filesystem::temp_directory_path().string();
  std::string json_file;
};

template <typename T>
T checked(result::Result<T> made) {
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*made);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Of all threads of the process.
double cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double bytes_of(const std::filesystem::path& file) {
  double bytes = 0.0;
  for (const char* part : {"", "-wal"})
    if (std::filesystem::exists(file.string() + part))
      bytes += static_cast<double>(std::filesystem::file_size(file.string() + part));
  return bytes;
}

// A second of every tag after the other, as scans bring them.
std::vector<TagSample> make_samples(const Arguments& arguments, int only_kind = -1) {
  std::vector<Signal> signals;
  for (std::uint32_t i = 0; i < arguments.tags; ++i)
    signals.emplace_back(
        static_cast<SignalKind>(only_kind >= 0 ? only_kind : static_cast<int>(i) % kSignalKinds), kSecondNs,
        i + 1);
  std::vector<TagSample> samples;
  samples.reserve(arguments.samples);
  while (samples.size() < arguments.samples) {
    const auto tag = static_cast<std::uint32_t>(samples.size() % arguments.tags);
    samples.push_back({TagId(tag), signals[tag].next()});
  }
  return samples;
}

struct Ingest {
  double samples_per_s = 0.0;
  double cpu_us_per_sample = 0.0;
  double bytes_per_sample = 0.0;
};

template <typename Work>
Ingest timed(std::size_t samples, const std::filesystem::path& file, Work&& work) {
  const double cpu_begin = cpu_s();
  const auto begin = Clock::now();
  work();
  const double n = static_cast<double>(samples);
  Ingest made{n / seconds_since(begin), (cpu_s() - cpu_begin) / n * 1e6, 0.0};
  made.bytes_per_sample = bytes_of(file) / n;
  return made;
}

std::unique_ptr<Historian> open(const std::filesystem::path& file) {
  historian::HistorianOptions options;
  options.batch_samples = kBatch;
  options.most_queued_samples = 100'000'000;  // a bench must not drop
  options.most_bytes = 0;
  return checked(Historian::open(file, options));
}

std::vector<TagId> make_tags(Historian& historian, std::uint32_t count) {
  std::vector<TagId> tags;
  for (std::uint32_t i = 0; i < count; ++i) tags.push_back(checked(historian.tag("tag" + std::to_string(i))));
  return tags;
}

// Until everything is in the file and the file is closed, as the baselines do it.
Ingest measure_historian(const std::filesystem::path& file, const std::vector<TagSample>& samples,
                         std::uint32_t tags) {
  return timed(samples.size(), file, [&] {
    const auto historian = open(file);
    make_tags(*historian, tags);
    for (const TagSample& sample : samples) historian->append(sample.tag, sample.sample);
    checked(historian->flush());
    const auto status = historian->status();
    if (status.dropped + status.lost > 0 || status.kept != samples.size())
      throw std::runtime_error("the historian has lost samples");
  });
}

// Every sample is there after the file was closed and opened again.
void require_all(const std::filesystem::path& file, const std::vector<TagSample>& samples,
                 std::uint32_t tags) {
  const auto historian = open(file);
  std::vector<std::vector<Sample>> expected(tags);
  for (const TagSample& sample : samples) expected[sample.tag.value].push_back(sample.sample);
  for (const TagId tag : make_tags(*historian, tags)) {
    const std::size_t count = expected[tag.value].size();
    if (checked(historian->range(tag, {0, INT64_MAX}, count + 1)).samples != expected[tag.value])
      throw std::runtime_error("what was written is not what is read");
  }
}

template <typename Store>
Ingest measure_baseline(const std::filesystem::path& file, const std::vector<TagSample>& samples) {
  return timed(samples.size(), file, [&] {
    Store store(file);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      store.append(samples[i]);
      if (i % kBatch == kBatch - 1) store.commit();
    }
    store.commit();
  });
}

struct Queries {
  std::vector<double> ms;
  double median() {
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
  }
  double most() const { return *std::ranges::max_element(ms); }
};

void require_equal(const historian::Trend& ours, const std::vector<RowStore::Bucket>& rows) {
  std::size_t filled = 0;
  for (const historian::Summary& bucket : ours.buckets) filled += bucket.count > 0 ? 1 : 0;
  bool equal = filled == rows.size();
  for (const RowStore::Bucket& row : rows) {
    const historian::Summary& bucket = ours.buckets.at(static_cast<std::size_t>(row.number));
    equal = equal && bucket.least.value == row.least && bucket.greatest.value == row.greatest;
  }
  if (!equal) throw std::runtime_error("the trend is not that of the rows");
}

nlohmann::json measure_trend(const Arguments& arguments, const support::TemporaryFolder& folder) {
  const auto period_ns = static_cast<std::int64_t>(1e9 / arguments.rate_hz);
  const auto count = static_cast<std::size_t>(arguments.days * 86'400.0 * arguments.rate_hz);
  const auto historian = open(folder / "trend.db");
  const TagId tag = checked(historian->tag("level"));
  RowStore rows(folder / "rows.db");
  Signal signal(SignalKind::Real, period_ns, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Sample sample = signal.next();
    historian->append(tag, sample);
    rows.append({tag, sample});
    if (i % kBatch == kBatch - 1) rows.commit();
  }
  rows.commit();
  checked(historian->flush());
  const std::int64_t end_ns = static_cast<std::int64_t>(count) * period_ns;
  Queries ours, theirs;
  double cpu_ms = 0.0;
  for (int i = 0; i < kQueries; ++i) {  // windows that share no border with blocks or with one another
    const std::int64_t shift = std::int64_t{i} * 1'234'567'891;
    const double cpu_begin = cpu_s();
    auto begin = Clock::now();
    const auto trend = checked(historian->trend(tag, {shift, end_ns}, arguments.columns));
    ours.ms.push_back(1e3 * seconds_since(begin));
    cpu_ms += 1e3 * (cpu_s() - cpu_begin) / kQueries;
    if (i >= 3) continue;  // the rows take their time
    begin = Clock::now();
    const auto buckets = rows.trend(tag, shift, end_ns, trend.bucket_ns);
    theirs.ms.push_back(1e3 * seconds_since(begin));
    require_equal(trend, buckets);
  }
  std::printf("\n%zu samples of a tag over %.0f days, %zu columns\n", count, arguments.days,
              arguments.columns);
  std::printf("  historian    median %8.1f ms, longest %8.1f ms, %.1f ms CPU\n", ours.median(), ours.most(),
              cpu_ms);
  std::printf("  SQLite rows  median %8.1f ms, longest %8.1f ms   (the same extremes)\n", theirs.median(),
              theirs.most());
  return {{"trend_samples", count},
          {"trend_query_ms", ours.median()},
          {"trend_query_max_ms", ours.most()},
          {"trend_query_cpu_ms", cpu_ms},
          {"sqlite_rows_trend_query_ms", theirs.median()}};
}

void print(const char* name, const Ingest& ingest) {
  std::printf("  %-12s %12.0f samples/s %8.2f us CPU a sample %8.2f bytes a sample\n", name,
              ingest.samples_per_s, ingest.cpu_us_per_sample, ingest.bytes_per_sample);
  std::fflush(stdout);
}

nlohmann::json measure_ingest(const Arguments& arguments, const support::TemporaryFolder& folder) {
  const auto samples = make_samples(arguments);
  std::printf("%zu samples of %u slow signals, in batches of %zu\n", samples.size(), arguments.tags, kBatch);
  const Ingest ours = measure_historian(folder / "ours.db", samples, arguments.tags);
  print("historian", ours);
  require_all(folder / "ours.db", samples, arguments.tags);
  const Ingest rows = measure_baseline<RowStore>(folder / "plain.db", samples);
  print("SQLite rows", rows);
  const Ingest csv = measure_baseline<CsvStore>(folder / "plain.csv", samples);
  print("CSV", csv);
  nlohmann::json json = {{"samples", samples.size()},
                         {"historian_samples_per_s", ours.samples_per_s},
                         {"historian_cpu_us_per_sample", ours.cpu_us_per_sample},
                         {"bytes_per_sample", ours.bytes_per_sample},
                         {"sqlite_rows_samples_per_s", rows.samples_per_s},
                         {"sqlite_rows_cpu_us_per_sample", rows.cpu_us_per_sample},
                         {"sqlite_rows_bytes_per_sample", rows.bytes_per_sample},
                         {"csv_samples_per_s", csv.samples_per_s},
                         {"csv_cpu_us_per_sample", csv.cpu_us_per_sample},
                         {"csv_bytes_per_sample", csv.bytes_per_sample}};
  std::printf("\nkind by kind\n");
  for (int kind = 0; kind < kSignalKinds; ++kind) {
    Arguments few = arguments;
    few.samples = std::max<std::size_t>(arguments.samples / 8, 1);
    const std::string name = to_string(static_cast<SignalKind>(kind));
    const Ingest one = measure_historian(folder / (name + ".db"), make_samples(few, kind), few.tags);
    print(name.c_str(), one);
    json["bytes_per_sample_" + name] = one.bytes_per_sample;
  }
  return json;
}

int run(const Arguments& arguments) {
  const support::TemporaryFolder folder(arguments.folder);
  nlohmann::json json = measure_ingest(arguments, folder);
  json.update(measure_trend(arguments, folder));
  json.update(measure_alarms(arguments.alarms, folder.path()));
  if (json["alarm_changes_lost"] != 0) throw std::runtime_error("the journal has lost changes");
  if (arguments.json_file.empty()) return to_int(result::ExitCode::Done);
  std::ofstream file(arguments.json_file);
  file << json.dump(2) << "\n";
  return to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  stepwright::bench::Arguments arguments;
  CLI::App app("the historian beside rows of SQLite and lines of CSV", "bench_historian");
  app.add_option("--samples", arguments.samples, "to be written")->check(CLI::Range(1'000, 100'000'000));
  app.add_option("--tags", arguments.tags)->check(CLI::Range(1, 100'000));
  app.add_option("--days", arguments.days, "of the trend")->check(CLI::Range(0.01, 400.0));
  app.add_option("--rate", arguments.rate_hz, "samples a second of the trend")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_option("--columns", arguments.columns, "of the trend")->check(CLI::Range(1, 100'000));
  app.add_option("--changes", arguments.alarms.changes, "of alarms")->check(CLI::Range(100, 10'000'000));
  app.add_option("--alarm-seconds", arguments.alarms.seconds, "of 10,000 changes a second")
      ->check(CLI::Range(0.1, 3600.0));
  app.add_option("--folder", arguments.folder, "where files are written")->check(CLI::ExistingDirectory);
  app.add_option("--json", arguments.json_file);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : to_int(stepwright::result::ExitCode::Usage);
  }
  try {
    return stepwright::bench::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_historian: %s\n", error.what());
    return to_int(stepwright::result::ExitCode::RuntimeFault);
  }
}

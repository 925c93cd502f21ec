#include "tests/bench/historian/baselines.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tests/bench/historian/signals.h"

namespace stepwright::bench {
namespace {

template <typename T>
T checked(result::Result<T> made) {
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*made);
}

// The key is the order in which a trend reads.
constexpr const char* kSchema =
    "CREATE TABLE sample(tag INTEGER, time INTEGER, value REAL, quality INTEGER, PRIMARY KEY(tag, time)) "
    "WITHOUT ROWID;";

}  // namespace

RowStore::RowStore(const std::filesystem::path& file)
    : database_(checked(storage::Database::open(file, {}, kSchema))) {
  insert_ = checked(database_.prepare("INSERT INTO sample VALUES(?, ?, ?, ?)"));
  trend_ =
      checked(database_.prepare("SELECT (time - ?2) / ?4 AS bucket, min(value), max(value) FROM sample WHERE "
                                "tag = ?1 AND time BETWEEN ?2 AND ?3 "
                                "GROUP BY bucket ORDER BY bucket"));
}

void RowStore::append(const historian::TagSample& sample) {
  if (!begun_) checked(database_.execute("BEGIN"));
  begun_ = true;
  insert_->bind(1, std::int64_t{sample.tag.value})
      .bind(2, sample.sample.time_ns)
      .bind(3, sample.sample.value);
  checked(insert_->bind(4, static_cast<std::int64_t>(sample.sample.quality)).run());
}

void RowStore::commit() {
  if (begun_) checked(database_.execute("COMMIT"));
  begun_ = false;
}

std::vector<RowStore::Bucket> RowStore::trend(historian::TagId tag, std::int64_t from_ns, std::int64_t to_ns,
                                              std::int64_t bucket_ns) {
  std::vector<Bucket> buckets;
  trend_->bind(1, std::int64_t{tag.value}).bind(2, from_ns).bind(3, to_ns).bind(4, bucket_ns);
  while (checked(trend_->step())) buckets.push_back({trend_->integer(0), trend_->real(1), trend_->real(2)});
  return buckets;
}

CsvStore::CsvStore(const std::filesystem::path& file) : file_(std::fopen(file.c_str(), "w")) {
  if (file_ == nullptr) throw std::runtime_error(file.string() + " cannot be written");
}

CsvStore::~CsvStore() {
  std::fclose(file_);
}

void CsvStore::append(const historian::TagSample& sample) {
  std::array<char, 128> line{};
  char* at = line.data();
  char* const end = at + line.size();
  at = std::to_chars(at, end, sample.tag.value).ptr;
  *at++ = ',';
  at = std::to_chars(at, end, sample.sample.time_ns).ptr;
  *at++ = ',';
  at = std::to_chars(at, end, sample.sample.value).ptr;
  *at++ = ',';
  *at++ = static_cast<char>('0' + static_cast<int>(sample.sample.quality));
  *at++ = '\n';
  if (std::fwrite(line.data(), 1, static_cast<std::size_t>(at - line.data()), file_) == 0)
    throw std::runtime_error("the CSV file cannot be written");
}

void CsvStore::commit() {
  std::fflush(file_);
}

const char* to_string(SignalKind kind) {
  constexpr std::array<const char*, kSignalKinds> kNames = {"counts", "scaled", "real", "rounded"};
  return kNames[static_cast<std::size_t>(kind)];
}

historian::Sample Signal::next() {
  time_ns_ += period_ns_;
  const double before = value_;
  // Always another value: repeats would not be stored at all. A filtered one may stand still in a REAL.
  while (value_ == before) step();
  return {time_ns_, value_};
}

void Signal::step() {
  counts_ += std::round(step_(random_));
  filtered_ += 0.1 * (counts_ - filtered_);
  switch (kind_) {
    case SignalKind::Counts:
      value_ = counts_;
      break;
    case SignalKind::Scaled:
      value_ = counts_ * 0.0071428571;
      break;
    case SignalKind::Real:
      value_ = static_cast<double>(static_cast<float>(filtered_));
      break;
    case SignalKind::Rounded:
      value_ = std::round(counts_ * 7.1) / 100.0;
      break;
  }
}

}  // namespace stepwright::bench

#include "tests/bench/historian/baselines.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <type_traits>
#include <utility>

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

}  // namespace stepwright::bench

#include <fmt/format.h>
#include <sodium/crypto_hash_sha256.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>

#include "runtime/ground/files/files.h"
#include "supervisor/fleet/lattice/heuristic_table.h"

// The file, little-endian: "SWHT", version (u32), range in vertices (u32), 0 (u32), range and margin of the
// build in metres (2 f64), digest of the primitives (32 bytes), digest of all that follows (32 bytes), costs
// (u16 each).

namespace stepwright::fleet {

namespace {

using result::Result;

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderSize = 16 + 16 + 32 + 32;
constexpr std::int64_t kLongestFile = 512ll * 1024 * 1024;

void put(std::string& bytes, std::uint64_t value, int size) {
  for (int k = 0; k < size; ++k) bytes.push_back(static_cast<char>(value >> (8 * k)));
}

void put(std::string& bytes, const Digest& digest) {
  bytes.append(reinterpret_cast<const char*>(digest.data()), digest.size());
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

Digest digest_of(std::string_view bytes) {
  Digest digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return digest;
}

// All before the digest of the costs: two tables are of the same build if and only if these bytes are equal.
std::string identity(const PrimitiveSet& primitives, const TableOptions& options, std::int32_t range) {
  std::string bytes = "SWHT";
  put(bytes, kVersion, 4);
  put(bytes, static_cast<std::uint64_t>(range), 4);
  put(bytes, 0, 4);
  put(bytes, bits_of(options.range_m), 8);
  put(bytes, bits_of(options.margin_m), 8);
  put(bytes, primitives.digest());
  return bytes;
}

Result<std::string> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto refuse = [&](std::string message) {
    return result::fail("F0401", {file.string(), 0, 0}, std::move(message));
  };
  if (!std::filesystem::is_regular_file(file, error)) return refuse("there is no such file");
  const auto size = std::filesystem::file_size(file, error);
  if (error || size < kHeaderSize || size > static_cast<std::uintmax_t>(kLongestFile)) {
    return refuse("this is no heuristic table");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) return refuse("the file cannot be read");
  if (!bytes.starts_with("SWHT")) return refuse("this is no heuristic table");
  return bytes;
}

}  // namespace

Result<HeuristicTable> HeuristicTable::read(const PrimitiveSet& primitives, const TableOptions& options,
                                            const std::filesystem::path& file) {
  auto bytes = read_file(file);
  if (!bytes) return forward(bytes);
  HeuristicTable table(range_in_vertices(primitives, options));
  const std::string expected = identity(primitives, options, table.range_);
  if (bytes->compare(0, expected.size(), expected) != 0) {
    return result::fail("F0402", {file.string(), 0, 0},
                        "the table belongs to other primitives or another range");
  }
  const std::string_view body = std::string_view(*bytes).substr(kHeaderSize);
  const Digest digest = digest_of(body);
  if (body.size() != 2 * table.costs_.size() ||
      std::memcmp(bytes->data() + expected.size(), digest.data(), digest.size()) != 0) {
    return result::fail("F0403", {file.string(), 0, 0}, "the table is damaged");
  }
  for (std::size_t k = 0; k < table.costs_.size(); ++k) {
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(body[at]); };
    table.costs_[k] = static_cast<std::uint16_t>(byte(2 * k) | byte(2 * k + 1) << 8);
  }
  return table;
}

Result<void> HeuristicTable::write(const PrimitiveSet& primitives, const TableOptions& options,
                                   const std::filesystem::path& file) const {
  std::string body;
  body.reserve(2 * costs_.size());
  for (const std::uint16_t cost : costs_) put(body, cost, 2);
  std::string header = identity(primitives, options, range_);
  put(header, digest_of(body));
  return files::write_file(file.string(), header + body, {"F0404"});
}

HeuristicTable::Loaded HeuristicTable::load_or_build(const PrimitiveSet& primitives,
                                                     const TableOptions& options,
                                                     const std::filesystem::path& file) {
  if (auto table = read(primitives, options, file)) {
    return {*std::move(table), false, {}};
  } else {
    Loaded loaded{build(primitives, options), true, to_string(table.error())};
    if (options.cancel != nullptr && options.cancel->load()) return loaded;
    if (auto written = loaded.table.write(primitives, options, file); !written) {
      loaded.unwritten = true;
      loaded.note += "\n" + to_string(written.error());
    }
    return loaded;
  }
}

}  // namespace stepwright::fleet

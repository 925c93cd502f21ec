#include "runtime/service/codec.h"

#include <concepts>
#include <cstring>
#include <type_traits>
#include <utility>

#include "runtime/base/byte_reader.h"

namespace stepwright::service {
namespace {

constexpr std::size_t kFrameHeader = 4;

template <typename T, typename Plain>
concept Like = std::same_as<std::remove_const_t<T>, Plain>;
template <typename T>
concept Number = std::integral<T> || std::floating_point<T>;

// The highest value of every enumeration on the wire.
constexpr Role last_of(Role) {
  return Role::Controller;
}
constexpr host::EventKind last_of(host::EventKind) {
  return host::EventKind::RolledBack;
}
constexpr host::DownloadMode last_of(host::DownloadMode) {
  return host::DownloadMode::ChangeRestartCharts;
}
constexpr host::RuntimeState last_of(host::RuntimeState) {
  return host::RuntimeState::Fault;
}
constexpr result::Severity last_of(result::Severity) {
  return result::Severity::Error;
}

// The fields of every structure in wire order, the same for writing and reading.
template <typename A, Like<Hello> T>
void fields(A& a, T& m) {
  a(m.version, m.role, m.first_event, m.name);
}
template <typename A, Like<Welcome> T>
void fields(A& a, T& m) {
  a(m.version);
}
template <typename A, Like<SupervisorLife> T>
void fields(A& a, T& m) {
  a(m.alive);
}
template <typename A, Like<Start> T>
void fields(A& a, T& m) {
  a(m.barrier, m.cold);
}
template <typename A, Like<Stop> T>
void fields(A& a, T& m) {
  a(m.reason);
}
template <typename A, Like<Acknowledge> T>
void fields(A& a, T& m) {
  a(m.event);
}
template <typename A, Like<host::ImageBits> T>
void fields(A& a, T& m) {
  a(m.byte_offset, m.mask, m.value);
}
template <typename A, Like<host::ProgramBits> T>
void fields(A& a, T& m) {
  a(m.program_digest, m.bits);
}
template <typename A, Like<Force> T>
void fields(A& a, T& m) {
  a(m.force.place, m.force.duration_ms);
}
template <typename A, typename T>
requires Like<T, Unforce> || Like<T, Write>
void fields(A& a, T& m) {
  a(m.place);
}
template <typename A, Like<host::BlockWrite> T>
void fields(A& a, T& m) {
  a(m.program_digest, m.parts);
}
template <typename A, Like<WriteBlock> T>
void fields(A& a, T& m) {
  a(m.block);
}
template <typename A, Like<InjectFault> T>
void fields(A& a, T& m) {
  a(m.name, m.value);
}
template <typename A, Like<DownloadBegin> T>
void fields(A& a, T& m) {
  a(m.total_bytes, m.digest);
}
template <typename A, Like<DownloadCommit> T>
void fields(A& a, T& m) {
  a(m.total_bytes, m.digest, m.mode);
}
template <typename A, Like<DownloadChunk> T>
void fields(A& a, T& m) {
  a(m.offset, m.data);
}
template <typename A, Like<ReadProgram> T>
void fields(A& a, T& m) {
  a(m.offset);
}
template <typename A, Like<ResendEvents> T>
void fields(A& a, T& m) {
  a(m.first);
}
template <typename A, typename T>
requires Like<T, ReadForces> || Like<T, Continue> || Like<T, EndRecording> || Like<T, ReadRecording>
void fields(A&, T&) {}
template <typename A, Like<Step> T>
void fields(A& a, T& m) {
  a(m.scans);
}
template <typename A, Like<BeginRecording> T>
void fields(A& a, T& m) {
  a(m.file, m.max_bytes, m.hash_every, m.keyframe_every);
}
template <typename A, Like<Reload> T>
void fields(A&, T&) {}
template <typename A, Like<Request> T>
void fields(A& a, T& m) {
  a(m.client, m.id, m.body);
}
template <typename A, Like<result::Location> T>
void fields(A& a, T& m) {
  a(m.file, m.line, m.column);
}
template <typename A, Like<result::Diagnostic> T>
void fields(A& a, T& m) {
  a(m.code, m.severity, m.where, m.message, m.hint);
}
template <typename A, Like<host::ChangeReport> T>
void fields(A& a, T& m) {
  a(m.carried, m.initialised, m.dropped, m.retyped, m.dropped_forces, m.pause_us);
}
template <typename A, Like<Reply> T>
void fields(A& a, T& m) {
  a(m.client, m.id, m.problems, m.digest, m.total_bytes, m.offset, m.data, m.change);
}
template <typename A, Like<host::NamedValue> T>
void fields(A& a, T& m) {
  a(m.name, m.value);
}
template <typename A, Like<host::StepEvent> T>
void fields(A& a, T& m) {
  a(m.sequence, m.scan, m.time_ns, m.kind, m.program_digest, m.detail, m.image, m.plant);
}
template <typename A, Like<host::DurationSpread> T>
void fields(A& a, T& m) {
  a(m.p50_us, m.p99_us, m.p999_us, m.p9999_us, m.max_us);
}
template <typename A, Like<host::TaskStatus> T>
void fields(A& a, T& m) {
  a(m.name, m.interval_us, m.priority, m.cycles, m.overruns, m.skipped, m.latency, m.execution, m.jitter);
}
template <typename A, Like<host::DurationCounts> T>
void fields(A& a, T& m) {
  a(m.first, m.counts);
}
template <typename A, Like<host::TaskDetail> T>
void fields(A& a, T& m) {
  a(m.name, m.watchdog_us, m.watchdog_sensitivity, m.too_long, m.watchdog_expiries, m.latency, m.execution,
    m.jitter);
}
template <typename A, Like<host::RuntimeStatus> T>
void fields(A& a, T& m) {
  a(m.incarnation, m.state, m.program_digest, m.scan, m.time_ns, m.last_event, m.overruns, m.scan_p50_us,
    m.scan_p99_us, m.scan_max_us, m.realtime_factor, m.trace_hash, m.waiting_for_supervisor, m.detail,
    m.changes, m.last_change_pause_us, m.plant, m.tasks, m.task_details, m.process.version,
    m.process.uptime_s, m.process.resident_bytes, m.process.clients, m.process.traps, m.process.lost_events,
    m.process.warnings);
}

class Encoder {
 public:
  explicit Encoder(std::vector<std::byte>& out) : out_(out) {}

  template <typename... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  template <Number T>
  void put(T value) {
    raw(&value, sizeof value);
  }
  template <typename T>
  requires std::is_enum_v<T>
  void put(T value) { put(static_cast<std::uint8_t>(value)); }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    raw(text.data(), text.size());
  }
  void put(const std::vector<std::byte>& bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    raw(bytes.data(), bytes.size());
  }
  void put(const Sha256& digest) { raw(digest.data(), digest.size()); }
  template <typename T>
  void put(const std::vector<T>& list) {
    put(static_cast<std::uint32_t>(list.size()));
    for (const T& element : list) put(element);
  }
  template <typename... T>
  void put(const std::variant<T...>& choice) {
    put(static_cast<std::uint8_t>(choice.index()));
    std::visit([this](const auto& value) { put(value); }, choice);
  }
  template <typename T>
  requires std::is_class_v<T>
  void put(const T& structure) { fields(*this, structure); }

  void raw(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    out_.insert(out_.end(), bytes, bytes + size);
  }

  std::vector<std::byte>& out_;
};

class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : in_(bytes) {}

  template <typename... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  bool whole() const { return good_ && in_.ok() && in_.at_end(); }

 private:
  template <Number T>
  void get(T& value) {
    value = in_.read<T>();
  }
  void get(bool& value) {
    const auto byte = in_.read<std::uint8_t>();
    good_ = good_ && byte <= 1;
    value = byte == 1;
  }
  template <typename T>
  requires std::is_enum_v<T>
  void get(T& value) {
    const auto number = in_.read<std::uint8_t>();
    good_ = good_ && number <= static_cast<std::uint8_t>(last_of(T{}));
    if (good_) value = static_cast<T>(number);
  }
  void get(std::string& text) {
    const auto bytes = in_.read_bytes(in_.read<std::uint32_t>());
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  void get(std::vector<std::byte>& list) {
    const auto bytes = in_.read_bytes(in_.read<std::uint32_t>());
    list.assign(bytes.begin(), bytes.end());
  }
  void get(Sha256& digest) {
    const auto bytes = in_.read_bytes(digest.size());
    if (bytes.size() == digest.size()) std::memcpy(digest.data(), bytes.data(), digest.size());
  }
  // Grows with what is really there, whatever count the sender claims.
  template <typename T>
  void get(std::vector<T>& list) {
    const auto count = in_.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < count && good_ && in_.ok(); ++i) get(list.emplace_back());
  }
  template <typename... T>
  void get(std::variant<T...>& choice) {
    const auto index = in_.read<std::uint8_t>();
    if (!in_.ok() || index >= sizeof...(T)) {
      good_ = false;
      return;
    }
    choose(choice, index, std::index_sequence_for<T...>{});
  }
  template <typename... T, std::size_t... I>
  void choose(std::variant<T...>& choice, std::size_t index, std::index_sequence<I...>) {
    ((index == I ? get(choice.template emplace<I>()) : void()), ...);
  }
  template <typename T>
  requires std::is_class_v<T>
  void get(T& structure) { fields(*this, structure); }

  base::ByteReader in_;
  bool good_ = true;
};

}  // namespace

bool encode_frame(const Message& message, std::vector<std::byte>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + kFrameHeader);
  Encoder encoder(out);
  encoder(message);
  const std::size_t size = out.size() - begin - kFrameHeader;
  if (size > kMaxMessageBytes) {
    out.resize(begin);
    return false;
  }
  const auto header = static_cast<std::uint32_t>(size);
  std::memcpy(out.data() + begin, &header, sizeof header);
  return true;
}

result::Result<Message> decode(std::span<const std::byte> body) {
  Message message;
  Decoder decoder(body);
  decoder(message);
  if (!decoder.whole()) {
    return result::fail("R0005", {}, "a message of " + std::to_string(body.size()) + " bytes is malformed");
  }
  return message;
}

void FrameBuffer::append(std::span<const std::byte> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(used_));
  used_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

result::Result<std::optional<std::span<const std::byte>>> FrameBuffer::next() {
  const std::span<const std::byte> rest = std::span<const std::byte>(bytes_).subspan(used_);
  if (rest.size() < kFrameHeader) return std::nullopt;
  std::uint32_t size = 0;
  std::memcpy(&size, rest.data(), sizeof size);
  if (size > kMaxMessageBytes) {
    return result::fail("R0005", {},
                        "a frame of " + std::to_string(size) + " bytes is longer than any message");
  }
  if (rest.size() - kFrameHeader < size) return std::nullopt;
  used_ += kFrameHeader + size;
  return rest.subspan(kFrameHeader, size);
}

}  // namespace stepwright::service

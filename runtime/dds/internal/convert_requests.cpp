#include <cstring>
#include <utility>

#include "runtime/dds/internal/convert.h"
#include "runtime/host/limits.h"

namespace stepwright::dds::internal {
namespace {

using namespace service;

// Kinds of an ExtraCommand.
constexpr std::uint8_t kWriteBlock = 0;
constexpr std::uint8_t kReadForces = 1;
constexpr std::uint8_t kForce = 2;
constexpr std::uint8_t kUnforce = 3;
constexpr std::uint8_t kWrite = 4;

idl::Digest to_digest(const Sha256& digest) {
  idl::Digest bytes;
  std::memcpy(bytes.data(), digest.data(), digest.size());
  return bytes;
}

Sha256 from_digest(const idl::Digest& bytes) {
  Sha256 digest;
  std::memcpy(digest.data(), bytes.data(), digest.size());
  return digest;
}

idl::BitsCommand to_bits(const host::ImageBits& bits) {
  idl::BitsCommand out;
  out.byte_offset(bits.byte_offset);
  out.mask(bits.mask);
  out.value(bits.value);
  return out;
}

host::ImageBits from_bits(const idl::BitsCommand& bits) {
  return {bits.byte_offset(), bits.mask(), bits.value()};
}

// The union sets its discriminator to the first label of a member; where several share one, set it after the
// member.
struct BodyWriter {
  idl::CommandBody& out;

  void operator()(const Start& body) const {
    idl::StartCommand command;
    command.barrier(body.barrier);
    command.cold(body.cold);
    out.start(command);
  }
  void operator()(const Stop& body) const {
    idl::StopCommand command;
    command.reason(body.reason);
    out.stop(command);
  }
  void operator()(const Acknowledge& body) const { event(body.event, idl::CMD_ACKNOWLEDGE); }
  void operator()(const ResendEvents& body) const { event(body.first, idl::CMD_RESEND_EVENTS); }
  void operator()(const InjectFault& body) const {
    idl::FaultCommand command;
    command.name(body.name);
    command.value(body.value);
    out.fault(command);
  }
  void operator()(const DownloadBegin& body) const {
    download(body.total_bytes, body.digest, host::DownloadMode::Replace, idl::CMD_DOWNLOAD_BEGIN);
  }
  void operator()(const DownloadCommit& body) const {
    download(body.total_bytes, body.digest, body.mode, idl::CMD_DOWNLOAD_COMMIT);
  }
  void operator()(const ReadProgram& body) const {
    idl::ReadProgramCommand command;
    command.offset(body.offset);
    out.read(command);
  }
  void operator()(const DownloadChunk&) const {}  // travels as a ProgramChunk
  void operator()(const ReadForces&) const {}     // these as an ExtraCommand
  void operator()(const Force&) const {}
  void operator()(const Unforce&) const {}
  void operator()(const Write&) const {}
  void operator()(const WriteBlock&) const {}
  // These do not travel.
  void operator()(const Step&) const {}
  void operator()(const Continue&) const {}
  void operator()(const BeginRecording&) const {}
  void operator()(const EndRecording&) const {}
  void operator()(const ReadRecording&) const {}
  void operator()(const Reload&) const {}  // for those at the machine: no RuntimeClient sends it

 private:
  void event(std::uint64_t sequence, idl::CommandKind kind) const {
    idl::EventCommand command;
    command.event(sequence);
    out.event(command);
    out._d(kind);
  }
  void download(std::uint64_t total, const Sha256& digest, host::DownloadMode mode,
                idl::CommandKind kind) const {
    idl::DownloadCommand command;
    command.total_bytes(total);
    command.digest(to_digest(digest));
    command.mode(static_cast<std::uint8_t>(mode));
    out.download(command);
    out._d(kind);
  }
};

std::optional<RequestBody> from_body(const idl::CommandBody& body) {
  switch (body._d()) {
    case idl::CMD_START:
      return Start{body.start().barrier(), body.start().cold()};
    case idl::CMD_STOP:
      if (body.stop().reason().size() > host::kMaxReasonBytes) return std::nullopt;
      return Stop{body.stop().reason()};
    case idl::CMD_ACKNOWLEDGE:
      return Acknowledge{body.event().event()};
    case idl::CMD_RESEND_EVENTS:
      return ResendEvents{body.event().event()};
    // Of earlier versions, without a program: the runtime tells them so.
    case idl::CMD_FORCE:
      return Force{{{{}, from_bits(body.bits())}}};
    case idl::CMD_UNFORCE:
      return Unforce{{{}, from_bits(body.bits())}};
    case idl::CMD_WRITE:
      return Write{{{}, from_bits(body.bits())}};
    case idl::CMD_INJECT_FAULT:
      if (body.fault().name().size() > host::kMaxNameBytes) return std::nullopt;
      return InjectFault{body.fault().name(), body.fault().value()};
    case idl::CMD_DOWNLOAD_BEGIN:
      return DownloadBegin{body.download().total_bytes(), from_digest(body.download().digest())};
    case idl::CMD_DOWNLOAD_COMMIT:
      if (body.download().mode() > static_cast<std::uint8_t>(host::DownloadMode::ChangeRestartCharts))
        return std::nullopt;
      return DownloadCommit{body.download().total_bytes(), from_digest(body.download().digest()),
                            static_cast<host::DownloadMode>(body.download().mode())};
    case idl::CMD_READ_PROGRAM:
      return ReadProgram{body.read().offset()};
  }
  return std::nullopt;
}

}  // namespace

bool travels(const RequestBody& body) {
  return !std::holds_alternative<Step>(body) && !std::holds_alternative<Continue>(body) &&
         !std::holds_alternative<BeginRecording>(body) && !std::holds_alternative<EndRecording>(body) &&
         !std::holds_alternative<ReadRecording>(body);
}

bool is_extra(const RequestBody& body) {
  return std::holds_alternative<WriteBlock>(body) || std::holds_alternative<ReadForces>(body) ||
         std::holds_alternative<Force>(body) || std::holds_alternative<Unforce>(body) ||
         std::holds_alternative<Write>(body);
}

idl::Command to_command(const std::string& runtime_id, const Request& request) {
  idl::Command sample;
  sample.runtime_id(runtime_id);
  sample.client(request.client);
  sample.request(request.id);
  std::visit(BodyWriter{sample.body()}, request.body);
  return sample;
}

idl::ProgramChunk to_chunk(const std::string& runtime_id, const Request& request) {
  const auto& chunk = std::get<DownloadChunk>(request.body);
  idl::ProgramChunk sample;
  sample.runtime_id(runtime_id);
  sample.client(request.client);
  sample.request(request.id);
  sample.offset(chunk.offset);
  sample.data().resize(chunk.data.size());
  std::memcpy(sample.data().data(), chunk.data.data(), chunk.data.size());
  return sample;
}

idl::ExtraCommand to_extra(const std::string& runtime_id, const Request& request) {
  idl::ExtraCommand sample;
  sample.runtime_id(runtime_id);
  sample.client(request.client);
  sample.request(request.id);
  const auto place = [&](std::uint8_t kind, const host::ProgramBits& bits) {
    sample.kind(kind);
    sample.program_digest(bits.program_digest);
    sample.parts().push_back(to_bits(bits.bits));
  };
  sample.kind(kReadForces);
  if (const auto* force = std::get_if<Force>(&request.body)) {
    place(kForce, force->force.place);
    sample.duration_ms(force->force.duration_ms);
  } else if (const auto* unforce = std::get_if<Unforce>(&request.body)) {
    place(kUnforce, unforce->place);
  } else if (const auto* write = std::get_if<Write>(&request.body)) {
    place(kWrite, write->place);
  } else if (const auto* block = std::get_if<WriteBlock>(&request.body)) {
    sample.kind(kWriteBlock);
    sample.program_digest(block->block.program_digest);
    for (const host::ImageBits& part : block->block.parts) sample.parts().push_back(to_bits(part));
  }
  return sample;
}

std::optional<Request> from_command(const idl::Command& sample) {
  auto body = from_body(sample.body());
  if (!body) return std::nullopt;
  return Request{sample.client(), sample.request(), std::move(*body)};
}

std::optional<Request> from_extra(const idl::ExtraCommand& sample) {
  if (sample.kind() == kReadForces) return Request{sample.client(), sample.request(), ReadForces{}};
  const std::size_t most = sample.kind() == kWriteBlock ? host::kMaxBlockWrites : 1;
  if (sample.parts().empty() || sample.parts().size() > most ||
      sample.program_digest().size() > host::kDigestLetters)
    return std::nullopt;
  Request request{sample.client(), sample.request(), {}};
  const host::ProgramBits place{sample.program_digest(), from_bits(sample.parts().front())};
  switch (sample.kind()) {
    case kForce:
      request.body = Force{{place, sample.duration_ms()}};
      return request;
    case kUnforce:
      request.body = Unforce{place};
      return request;
    case kWrite:
      request.body = Write{place};
      return request;
    case kWriteBlock: {
      WriteBlock write{{sample.program_digest(), {}}};
      for (const idl::BitsCommand& part : sample.parts()) write.block.parts.push_back(from_bits(part));
      request.body = std::move(write);
      return request;
    }
    default:
      return std::nullopt;
  }
}

std::optional<Request> from_chunk(const idl::ProgramChunk& sample) {
  if (sample.data().size() > host::kMaxChunkBytes) return std::nullopt;
  DownloadChunk chunk;
  chunk.offset = sample.offset();
  const auto* bytes = reinterpret_cast<const std::byte*>(sample.data().data());
  chunk.data.assign(bytes, bytes + sample.data().size());
  return Request{sample.client(), sample.request(), std::move(chunk)};
}

}  // namespace stepwright::dds::internal

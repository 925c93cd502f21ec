#include "runtime/service/internal/request_handler.h"

#include <algorithm>
#include <utility>

#include "runtime/host/busy.h"
#include "runtime/host/limits.h"
#include "runtime/service/digest.h"
#include "runtime/service/monitor_answers.h"

namespace stepwright::service::internal {
namespace {

using host::CommandKind;
using host::Outcome;

template <typename... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};

constexpr std::size_t kShortDigest = 12;
constexpr std::uint64_t kNsPerMs = 1'000'000;

// The program whose memory a request names; null: it names none.
const std::string* meant_by(const RequestBody& body) {
  if (const auto* force = std::get_if<Force>(&body)) return &force->force.place.program_digest;
  if (const auto* unforce = std::get_if<Unforce>(&body)) return &unforce->place.program_digest;
  if (const auto* write = std::get_if<Write>(&body)) return &write->place.program_digest;
  const auto* block = std::get_if<WriteBlock>(&body);
  return block == nullptr ? nullptr : &block->block.program_digest;
}

result::Diagnostics other_program(std::string_view meant, std::string_view loaded) {
  const auto brief = [](std::string_view digest) { return std::string(digest.substr(0, kShortDigest)); };
  auto failed =
      result::fail(kOtherProgram, {},
                   (meant.empty() ? std::string("the request does not say of which program its addresses are")
                                  : "the addresses are of the program " + brief(meant)) +
                       ", and " + brief(loaded) + " is loaded: nothing was changed",
                   "read the program that is loaded, and look the variable up in it");
  return std::move(failed.value());
}

result::Diagnostics explain(const host::Completion& completion, std::string_view meant) {
  const auto one = [](const char* code, const char* message, const char* hint) {
    auto failed = result::fail(code, {}, message, hint);
    return std::move(failed.value());
  };
  switch (completion.outcome) {
    case Outcome::Done:
      return completion.problems;  // notes, if any
    case Outcome::NoProgram:
      return one("R0002", "no program is loaded", "download one first");
    case Outcome::AlreadyRunning:
      return one("R0002", "the program is running already", "stop it first");
    case Outcome::IoLost:
      return one("R0008", "the I/O does not answer: the program would stop in its first scan",
                 "see the devices and the process that speaks to them, then start again");
    case Outcome::OutOfBounds:
      return one("R0004",
                 "the bits are not within the process image, or are neither one bit nor 1, 2, 4 or 8 bytes",
                 "the container's symbols say where each variable lies");
    case Outcome::ForcesFull:
      return one("R0004", "too many variables are forced already", "release some");
    case Outcome::NotForced:
      return one("R0002", "nothing is forced there", "");
    case Outcome::NoPlant:
      return one("R0002", "this runtime has no simulated plant", "");
    case Outcome::PlantRefused:
    case Outcome::NotRunning:
    case Outcome::ChangeOutdated:
    case Outcome::StepLost:
    case Outcome::StepsUnfit:
    case Outcome::RetainRefused:
    case Outcome::Refused:
      return completion.problems;
    case Outcome::Overtaken:
      return one("R0002", "a stop was asked for after this start", "start again");
    case Outcome::ProgramDiffers:
      return other_program(meant, completion.program_digest.view());
    case Outcome::NotSimulated:
      return one("R0002", "in real time nothing stands still",
                 "step mode needs [clock] mode = \"simulated\"");
  }
  return {};
}

tl::unexpected<result::Diagnostics> too_many() {
  return result::fail(host::kBusy, {}, "too many commands of this client are under way",
                      "wait for their answers");
}

// The command of a request that the scan thread performs; none for the others.
std::optional<host::Command> to_command(const RequestBody& body) {
  host::Command command;
  const auto bits = [&](CommandKind kind, const host::ProgramBits& place) {
    command.kind = kind;
    command.bits = place.bits;
    command.program_digest = host::FixedText<host::kDigestLetters>(place.program_digest);
    return true;
  };
  const bool any =
      std::visit(Overloaded{
                     [&](const Start& start) {
                       command.kind = CommandKind::Start;
                       command.barrier = start.barrier;
                       command.cold = start.cold;
                       return true;
                     },
                     [&](const Stop& stop) {
                       command.kind = CommandKind::Stop;
                       command.text = host::FixedText<host::kMaxReasonBytes>(stop.reason);
                       return true;
                     },
                     [&](const Acknowledge& acknowledge) {
                       command.kind = CommandKind::Acknowledge;
                       command.event = acknowledge.event;
                       return true;
                     },
                     [&](const Force& force) {
                       command.duration_ns = static_cast<std::int64_t>(force.force.duration_ms * kNsPerMs);
                       return bits(CommandKind::Force, force.force.place);
                     },
                     [&](const Unforce& unforce) { return bits(CommandKind::Unforce, unforce.place); },
                     [&](const Write& write) { return bits(CommandKind::Write, write.place); },
                     [&](const InjectFault& fault) {
                       command.kind = CommandKind::InjectFault;
                       command.text = host::FixedText<host::kMaxReasonBytes>(fault.name);
                       command.value = fault.value;
                       return true;
                     },
                     [&](const Step& step) {
                       command.kind = CommandKind::Step;
                       command.count = step.scans;
                       return true;
                     },
                     [&](const Continue&) {
                       command.kind = CommandKind::Continue;
                       return true;
                     },
                     [&](const EndRecording&) {
                       command.kind = CommandKind::RecordEnd;
                       return true;
                     },
                     [](const auto&) { return false; },
                 },
                 body);
  return any ? std::optional(command) : std::nullopt;
}

}  // namespace

bool only_reads(const RequestBody& body) {
  return std::holds_alternative<ReadProgram>(body) || std::holds_alternative<ResendEvents>(body) ||
         std::holds_alternative<ReadForces>(body) || std::holds_alternative<ReadRecording>(body) ||
         std::holds_alternative<ReadFaults>(body);
}

std::optional<Reply> RequestHandler::handle(std::uint64_t session, const Request& request) {
  if (const Reply* known = replies_.find(request.client, request.id)) return *known;
  for (auto& [ticket, pending] : pending_) {
    if (pending.reply.client != request.client || pending.reply.id != request.id) continue;
    pending.session = session;  // it asks again over a new connection
    return std::nullopt;
  }
  Reply reply;
  reply.client = request.client;
  reply.id = request.id;
  const std::uint64_t ticket = ++last_ticket_;
  const std::string* meant = meant_by(request.body);
  auto performed =
      has_share(session, request.body) ? perform(request, ticket, reply) : result::Result<bool>(too_many());
  if (performed && !*performed) {
    Pending pending{session, std::move(reply), meant == nullptr ? std::string() : *meant, {}};
    if (const auto* commit = std::get_if<DownloadCommit>(&request.body)) pending.commit = *commit;
    pending_.emplace(ticket, std::move(pending));
    return std::nullopt;
  }
  if (!performed) reply.problems = std::move(performed.error());
  if (!only_reads(request.body)) replies_.add(reply);
  return reply;
}

bool RequestHandler::has_share(std::uint64_t session, const RequestBody& body) const {
  const bool piece =
      std::holds_alternative<DownloadBegin>(body) || std::holds_alternative<DownloadChunk>(body);
  if (only_reads(body) || piece || std::holds_alternative<Stop>(body)) return true;
  const auto own = static_cast<std::size_t>(std::count_if(
      pending_.begin(), pending_.end(), [&](const auto& each) { return each.second.session == session; }));
  return own + pending_.size() < kMaxPending;
}

std::optional<Answer> RequestHandler::complete(const host::Completion& completion) {
  const auto found = pending_.find(completion.ticket);
  if (found == pending_.end()) return std::nullopt;
  Answer answer{found->second.session, std::move(found->second.reply), found->second.commit};
  const std::string meant = std::move(found->second.meant);
  pending_.erase(found);
  answer.reply.problems = explain(completion, meant);
  answer.reply.offset = completion.scan;
  answer.reply.change = completion.change;
  return answer;
}

result::Result<bool> RequestHandler::perform(const Request& request, std::uint64_t ticket, Reply& reply) {
  const auto at_once = [](result::Result<void> done) -> result::Result<bool> {
    if (!done) return result::forward(done);
    return true;
  };
  if (const auto* meant = meant_by(request.body); meant != nullptr && meant->size() > host::kDigestLetters)
    return result::fail("R0004", {}, "no digest of a program is so long");
  if (const auto* begin = std::get_if<DownloadBegin>(&request.body)) {
    return at_once(downloads_.begin(request.client, *begin));
  }
  if (const auto* chunk = std::get_if<DownloadChunk>(&request.body)) {
    return at_once(downloads_.add(request.client, *chunk));
  }
  if (const auto* body = std::get_if<DownloadCommit>(&request.body))
    return commit(request, *body, ticket, reply);
  if (const auto* body = std::get_if<ReadProgram>(&request.body)) return read_program(*body, reply);
  if (const auto* resend = std::get_if<ResendEvents>(&request.body)) {
    // The server sends the events; the reply says with which they begin.
    const host::StepEvent* first = events_.at_or_after(resend->first);
    reply.offset = first == nullptr ? events_.last() + 1 : first->sequence;
    return true;
  }
  if (std::holds_alternative<ReadForces>(request.body)) {
    host::Forces forces = port_.forces();
    reply.digest = std::move(forces.program_digest);
    reply.data = encode_forces(forces.places);
    return true;
  }
  if (const auto* body = std::get_if<ReadFaults>(&request.body)) {
    const std::vector<host::PlantFault> faults = port_.faults();
    reply.total_bytes = faults.size();
    reply.data =
        encode_faults(std::span(faults).subspan(std::min<std::uint64_t>(body->first, faults.size())));
    return true;
  }
  if (std::holds_alternative<ReadRecording>(request.body)) {
    reply.data = encode_recording(port_.recording());
    return true;
  }
  if (const auto* body = std::get_if<BeginRecording>(&request.body)) return record(*body, ticket);
  if (const auto* body = std::get_if<WriteBlock>(&request.body)) return write(*body, ticket);
  return submit(request.body, ticket);
}

result::Result<bool> RequestHandler::write(const WriteBlock& body, std::uint64_t ticket) {
  if (body.block.parts.empty() || body.block.parts.size() > host::kMaxBlockWrites) {
    return result::fail("R0004", {}, "a block has 1 to " + std::to_string(host::kMaxBlockWrites) + " parts");
  }
  auto written = port_.write(ticket, body.block);
  if (!written) return result::forward(written);
  return false;
}

result::Result<bool> RequestHandler::record(const BeginRecording& body, std::uint64_t ticket) {
  if (body.file.empty() || body.file.front() != '/' || body.file.size() > host::kMaxPathBytes) {
    return result::fail("R0004", {body.file, 0, 0}, "the file of a recording needs an absolute path");
  }
  record::RecordingOptions options;
  options.file = body.file;
  options.max_bytes = body.max_bytes;
  options.hash_every = body.hash_every;
  options.keyframe_every = body.keyframe_every;
  auto begun = port_.record(ticket, options);
  if (!begun) return result::forward(begun);
  return false;
}

result::Result<bool> RequestHandler::submit(const RequestBody& body, std::uint64_t ticket) {
  const auto* stop = std::get_if<Stop>(&body);
  const auto* fault = std::get_if<InjectFault>(&body);
  if ((stop != nullptr && stop->reason.size() > host::kMaxReasonBytes) ||
      (fault != nullptr && fault->name.size() > host::kMaxNameBytes)) {
    return result::fail("R0004", {}, "the text of the request is too long");
  }
  const auto* force = std::get_if<Force>(&body);
  if (force != nullptr && force->force.duration_ms > host::kMaxForceMs)
    return result::fail("R0004", {}, "a force that ends lasts a year at most");
  auto command = to_command(body);
  command->ticket = ticket;
  if (!port_.submit(*command)) return host::busy();
  return false;
}

result::Result<bool> RequestHandler::commit(const Request& request, const DownloadCommit& body,
                                            std::uint64_t ticket, Reply& reply) {
  auto container = downloads_.commit(request.client, body);
  if (!container) return result::forward(container);
  reply.digest = to_hex(body.digest);
  auto loading = body.mode == host::DownloadMode::Replace
                     ? port_.load(ticket, std::move(*container), reply.digest)
                     : port_.change(ticket, std::move(*container), reply.digest, body.mode);
  if (!loading) return result::forward(loading);
  return false;
}

result::Result<bool> RequestHandler::read_program(const ReadProgram& body, Reply& reply) const {
  const std::span<const std::byte> program = port_.program();
  if (program.empty()) return result::fail("R0002", {}, "no program is loaded");
  if (body.offset >= program.size()) {
    return result::fail("R0004", {}, "the program ends at " + std::to_string(program.size()) + " bytes");
  }
  const auto part =
      program.subspan(body.offset, std::min(host::kMaxChunkBytes, program.size() - body.offset));
  reply.digest = port_.status().program_digest;
  reply.total_bytes = program.size();
  reply.offset = body.offset;
  reply.data.assign(part.begin(), part.end());
  return true;
}

}  // namespace stepwright::service::internal

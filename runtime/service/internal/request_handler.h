#pragma once

// Performs the requests of all clients on a runtime, each once.
//
// Threads: the service's. A request is answered at once, or, if the scan thread has to act, when its
// completion comes. However many commands a client sends, those of others are taken (kMaxPending).

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "runtime/host/runtime_port.h"
#include "runtime/service/internal/downloads.h"
#include "runtime/service/internal/event_history.h"
#include "runtime/service/internal/reply_cache.h"
#include "runtime/service/requests.h"

namespace stepwright::service::internal {

// A reply and the session that waits for it.
struct Answer {
  std::uint64_t session = 0;
  Reply reply;
  std::optional<DownloadCommit> commit;  // that it answers, if it is one
};

// A request that changes nothing: an observer may send it, and it is performed again instead of remembered,
// for its answer is large, or the events themselves.
bool only_reads(const RequestBody& body);

class RequestHandler {
 public:
  static constexpr std::size_t kMaxPending = 200;  // of all clients together; stops come on top

  // Both must outlive the handler.
  RequestHandler(host::RuntimePort& port, const EventHistory& events) : port_(port), events_(events) {}

  // The reply, if it is known now.
  std::optional<Reply> handle(std::uint64_t session, const Request& request);
  // The reply that the scan thread's completion makes possible, and whom it is for; none for commands that
  // the service itself gave.
  std::optional<Answer> complete(const host::Completion& completion);
  // That answer is given: who asks again gets the same.
  void remember(const Reply& reply) { replies_.add(reply); }

 private:
  struct Pending {
    std::uint64_t session = 0;
    Reply reply;        // as it will be if the outcome is good
    std::string meant;  // the program that its addresses are of
    std::optional<DownloadCommit> commit;
  };

  // Whether this client may have one more command under way: as many as are free, so that there is always
  // room for another client. A stop is never one too many.
  bool has_share(std::uint64_t session, const RequestBody& body) const;
  // An error, a reply that is known at once (true), or one that waits for a completion (false).
  [[nodiscard]] result::Result<bool> perform(const Request& request, std::uint64_t ticket, Reply& reply);
  [[nodiscard]] result::Result<bool> submit(const RequestBody& body, std::uint64_t ticket);
  [[nodiscard]] result::Result<bool> commit(const Request& request, const DownloadCommit& body,
                                            std::uint64_t ticket, Reply& reply);
  [[nodiscard]] result::Result<bool> record(const BeginRecording& body, std::uint64_t ticket);
  [[nodiscard]] result::Result<bool> write(const WriteBlock& body, std::uint64_t ticket);
  [[nodiscard]] result::Result<bool> read_program(const ReadProgram& body, Reply& reply) const;

  host::RuntimePort& port_;
  const EventHistory& events_;
  Downloads downloads_;
  ReplyCache replies_;
  std::map<std::uint64_t, Pending> pending_;  // by ticket
  std::uint64_t last_ticket_ = 0;
};

}  // namespace stepwright::service::internal

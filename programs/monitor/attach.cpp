#include "programs/monitor/attach.h"

#include <thread>
#include <utility>

#include "cell/processes/cell_record.h"

namespace stepwright::monitor {

using namespace std::chrono_literals;

result::Result<std::unique_ptr<Attached>> Attached::open(const config::CellConfig& config,
                                                         service::Role role) {
  if (auto own = processes::check_state_folder(config); !own) return result::forward(own);
  auto connection = service::Connection::open(config.socket_path(), {.role = role, .name = "monitor"});
  if (!connection) return result::forward(connection);
  auto self = std::make_unique<Attached>();
  self->connection_ = std::move(*connection);
  return self;
}

result::Result<void> Attached::read_program() {
  std::vector<std::byte> container;
  std::string digest;
  do {
    auto part = ask(service::ReadProgram{container.size()});
    if (!part) return result::forward(part);
    // Another program has taken its place meanwhile.
    if (part->digest != digest) container.clear();
    const bool begins = part->offset == container.size();
    digest = part->digest;
    if (!begins) continue;
    container.insert(container.end(), part->data.begin(), part->data.end());
    if (container.size() == part->total_bytes) break;
  } while (true);
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  changed_ = info_.has_value() && digest != digest_;
  info_ = std::move(*info);
  digest_ = std::move(digest);
  return {};
}

result::Result<host::Snapshot> Attached::sample() {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    // The memory outlives the runtime: only the connection tells.
    static_cast<void>(status());
    if (connection_->closed()) return result::fail("R0001", {}, "the runtime has ended");
    auto snapshot = connection_->snapshot();
    if (snapshot && snapshot->program_digest == digest_) return std::move(*snapshot);
    if (auto read = read_program(); !read) return result::forward(read);
    std::this_thread::sleep_for(1ms);
  }
  return result::fail("R0001", {}, "the runtime publishes no image");
}

std::optional<host::RuntimeStatus> Attached::status() {
  auto wait = status_ ? 0ms : std::chrono::milliseconds(kPatience);
  while (auto message = connection_->receive(wait)) {
    auto* status = std::get_if<host::RuntimeStatus>(&*message);
    if (status == nullptr) continue;
    status_ = std::move(*status);
    wait = 0ms;
  }
  return status_;
}

}  // namespace stepwright::monitor

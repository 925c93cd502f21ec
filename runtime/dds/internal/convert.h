#pragma once

// Between the generated DDS types and those of service and host. Outwards every text and list is cut to its
// bound; inwards a sample that exceeds a bound or names an unknown kind is dropped whole (no value).

#include <optional>
#include <string>

#include "runtime/dds/health.h"
#include "runtime/dds/types.h"
#include "runtime/service/requests.h"
#include "runtime_types.h"

namespace stepwright::dds::internal {

// False for what is for people at the machine of the runtime: asked on its socket, never over the network.
bool travels(const service::RequestBody& body);
// True for what travels as an ExtraCommand: a link of another version does not understand it.
bool is_extra(const service::RequestBody& body);
// A request that travels and is neither an extra one nor a DownloadChunk.
idl::Command to_command(const std::string& runtime_id, const service::Request& request);
idl::ProgramChunk to_chunk(const std::string& runtime_id, const service::Request& request);
idl::ExtraCommand to_extra(const std::string& runtime_id, const service::Request& request);
std::optional<service::Request> from_command(const idl::Command& sample);
std::optional<service::Request> from_chunk(const idl::ProgramChunk& sample);
std::optional<service::Request> from_extra(const idl::ExtraCommand& sample);

idl::Reply to_reply(const std::string& runtime_id, const service::Reply& reply);
std::optional<service::Reply> from_reply(const idl::Reply& sample);

idl::Event to_event(const std::string& runtime_id, std::uint64_t incarnation, const StepEvent& event);
std::optional<StepEvent> from_event(const idl::Event& sample);

idl::Status to_status(const std::string& runtime_id, const RuntimeStatus& status, bool runtime_connected);
std::optional<RuntimeStatus> from_status(const idl::Status& sample);

// Of no more than the bound of tasks and devices, the first ones.
idl::Health to_health(const std::string& runtime_id, const RuntimeHealth& health);
std::optional<RuntimeHealth> from_health(const idl::Health& sample);

idl::Snapshot to_snapshot(const std::string& runtime_id, const Snapshot& snapshot);
std::optional<Snapshot> from_snapshot(const idl::Snapshot& sample);

}  // namespace stepwright::dds::internal

#include "firmware/app/transfer.h"

namespace stepwright::app {

using modbus::control::Refusal;
using modbus::pdu::Exception;

Judgement Transfer::begin(std::uint32_t bytes, const storage::Digest& digest, int in_use) {
  active_ = false;
  if (bytes > store_.capacity()) return {Refusal::TooLarge, store_.capacity()};
  if (bytes == 0) return {Refusal::BadArguments, 0};
  if (!store_.begin(in_use)) return {Refusal::FlashFailed, 0};
  bytes_ = bytes;
  arrived_ = 0;
  digest_ = digest;
  sum_ = {};
  summed_ = 0;
  active_ = true;
  return {};
}

Exception Transfer::piece(std::uint32_t offset, std::span<const std::byte> bytes) {
  if (!active_ || offset > bytes_ || bytes.size() > bytes_ - offset) return Exception::IllegalDataValue;
  const auto end = static_cast<std::uint32_t>(offset + bytes.size());
  if (end <= arrived_) return Exception::None;
  if (offset != arrived_) return Exception::IllegalDataValue;
  if (!store_.append(bytes)) {
    active_ = false;
    return Exception::DeviceFailure;
  }
  arrived_ = end;
  return Exception::None;
}

bool Transfer::digest_step() {
  constexpr std::size_t kStep = 1024;
  if (!active_ || arrived_ != bytes_ || summed_ == bytes_) return true;
  const auto rest = store_.written().subspan(summed_);
  const auto part = rest.first(rest.size() < kStep ? rest.size() : kStep);
  sum_.add(part);
  summed_ += static_cast<std::uint32_t>(part.size());
  return summed_ == bytes_;
}

Judgement Transfer::complete() {
  if (!active_) return {Refusal::Incomplete, 0};
  if (arrived_ != bytes_) return {Refusal::Incomplete, bytes_ - arrived_};
  if (sum_.finish() != digest_) return {Refusal::WrongDigest, 0};
  return {};
}

}  // namespace stepwright::app

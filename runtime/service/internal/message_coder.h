#pragma once

// Messages as bytes and back, by the lists of fields in message_fields.h: little-endian numbers, texts and
// lists behind their length (32 bits), a choice behind its number (8 bits).
//
// The decoder never reads beyond its bytes and never takes more memory than they can stand for. One thread
// per object.

#include <concepts>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/base/byte_reader.h"
#include "runtime/service/internal/message_fields.h"

namespace stepwright::service::internal {

template <typename T>
concept Number = std::integral<T> || std::floating_point<T>;

inline constexpr std::size_t kNoBound = std::numeric_limits<std::size_t>::max();

class Encoder {
 public:
  explicit Encoder(std::vector<std::byte>& out) : out_(out) {}

  template <typename... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  // False if something had more than may be sent.
  bool within_bounds() const { return good_; }

 private:
  template <Number T>
  void put(T value) {
    raw(&value, sizeof value);
  }
  template <typename T>
  requires std::is_enum_v<T>
  void put(T value) { put(static_cast<std::uint8_t>(value)); }
  void put(const std::string& text, std::size_t most = kNoBound) {
    const std::size_t size = std::min(most, text.size());
    put(static_cast<std::uint32_t>(size));
    raw(text.data(), size);
  }
  void put(const std::vector<std::byte>& bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    raw(bytes.data(), bytes.size());
  }
  void put(const Sha256& digest) { raw(digest.data(), digest.size()); }
  template <typename T>
  void put(const std::vector<T>& list, std::size_t most = kNoBound) {
    const std::size_t size = std::min(most, list.size());
    put(static_cast<std::uint32_t>(size));
    for (std::size_t i = 0; i < size; ++i) put(list[i]);
  }
  template <typename T>
  void put(const First<T>& bounded) {
    put(bounded.value, bounded.most);
  }
  template <typename T>
  void put(const AtMost<T>& bounded) {
    good_ = good_ && bounded.value.size() <= bounded.most;
    put(bounded.value);
  }
  template <typename T>
  void put(const Within<T>& bounded) {
    put(bounded.holds() ? bounded.value : bounded.least);
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
  bool good_ = true;
};

class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : in_(bytes) {}

  template <typename... T>
  void operator()(T&&... values) {
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
  void get(std::string& text, std::size_t most = kNoBound) {
    const auto bytes = in_.read_bytes(count(most));
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  void get(std::vector<std::byte>& list, std::size_t most = kNoBound) {
    const auto bytes = in_.read_bytes(count(most));
    list.assign(bytes.begin(), bytes.end());
  }
  void get(Sha256& digest) {
    const auto bytes = in_.read_bytes(digest.size());
    if (bytes.size() == digest.size()) std::memcpy(digest.data(), bytes.data(), digest.size());
  }
  // Grows with what is really there, whatever count the sender claims.
  template <typename T>
  void get(std::vector<T>& list, std::size_t most = kNoBound) {
    const std::size_t size = count(most);
    for (std::size_t i = 0; i < size && good_ && in_.ok(); ++i) get(list.emplace_back());
  }
  template <typename T>
  void get(First<T>& bounded) {
    get(bounded.value, bounded.most);
  }
  template <typename T>
  void get(AtMost<T>& bounded) {
    get(bounded.value, bounded.most);
  }
  template <typename T>
  void get(Within<T>& bounded) {
    get(bounded.value);
    good_ = good_ && bounded.holds();
  }
  // The length of a text or a list; 0 if it breaks the bound.
  std::size_t count(std::size_t most) {
    const std::size_t size = in_.read<std::uint32_t>();
    good_ = good_ && size <= most;
    return good_ ? size : 0;
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

}  // namespace stepwright::service::internal

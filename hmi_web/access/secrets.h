#pragma once

// Random tokens, passwords as argon2id hashes, SHA-256; all by libsodium, whose headers stay in this folder.
//
//   const std::string token = random_token();            // 256 bits, 43 characters of base64url
//   auto hash = hash_password("correct horse", {});       // "$argon2id$v=19$m=65536,t=3,p=1$..."
//   if (password_matches(*hash, "correct horse")) ...
//
// Pure but for the source of randomness; any thread. The password functions take a tenth of a second and the
// memory that the cost names.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::access {

struct PasswordCost {
  std::uint64_t passes = 3;
  std::size_t memory_bytes = 64u << 20;
};

std::string random_token();
// For people to type: five groups of four letters and digits, 100 bits.
std::string random_setup_token();

// Fails with H0020 when there is no memory for it.
[[nodiscard]] result::Result<std::string> hash_password(std::string_view password, const PasswordCost& cost);
// False for a hash that is none, too. Time does not depend on where texts differ.
bool password_matches(const std::string& hash, std::string_view password);
// Whether a text looks like a hash that password_matches can check.
bool is_password_hash(const std::string& text);

// Equal, in a time that depends on the lengths only.
bool same_secret(std::string_view a, std::string_view b);
// The standard alphabet with padding, and nothing else in between; nullopt if it is none.
std::optional<std::string> from_base64(std::string_view text);
// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace stepwright::access

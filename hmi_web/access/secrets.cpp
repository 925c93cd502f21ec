#include "hmi_web/access/secrets.h"

#include <sodium.h>

#include <array>
#include <cstdlib>

#include "hmi_web/access/codes.h"

namespace stepwright::access {
namespace {

// Safe to call again and again, from any thread; it fails only where there is no source of randomness.
void begin() {
  if (sodium_init() < 0) std::abort();
}

// Without letters and digits that look alike.
constexpr std::string_view kTypeable = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789";

}  // namespace

std::string random_token() {
  begin();
  std::array<unsigned char, 32> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  constexpr int kVariant = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), kVariant), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), kVariant);
  text.pop_back();  // the terminator that libsodium writes
  return text;
}

std::string random_setup_token() {
  begin();
  std::string text;
  for (int i = 0; i < 20; ++i) {
    if (i > 0 && i % 4 == 0) text += '-';
    text += kTypeable[randombytes_uniform(static_cast<std::uint32_t>(kTypeable.size()))];
  }
  return text;
}

result::Result<std::string> hash_password(std::string_view password, const PasswordCost& cost) {
  begin();
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (crypto_pwhash_str_alg(hash.data(), password.data(), password.size(), cost.passes, cost.memory_bytes,
                            crypto_pwhash_ALG_ARGON2ID13) != 0) {
    return result::fail(kNoMemoryToHash, {}, "there is not enough memory to hash a password",
                        std::to_string(cost.memory_bytes >> 20) + " MiB are needed for a moment");
  }
  return std::string(hash.data());
}

bool password_matches(const std::string& hash, std::string_view password) {
  begin();
  return is_password_hash(hash) &&
         crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

bool is_password_hash(const std::string& text) {
  return text.size() < crypto_pwhash_STRBYTES && text.starts_with(crypto_pwhash_STRPREFIX);
}

bool same_secret(std::string_view a, std::string_view b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::optional<std::string> from_base64(std::string_view text) {
  begin();
  std::string bytes(text.size() / 4 * 3 + 3, '\0');
  std::size_t length = 0;
  if (sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.data(),
                        text.size(), nullptr, &length, nullptr, sodium_base64_VARIANT_ORIGINAL) != 0)
    return std::nullopt;
  bytes.resize(length);
  return bytes;
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  std::string text(2 * digest.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
  text.pop_back();
  return text;
}

}  // namespace stepwright::access

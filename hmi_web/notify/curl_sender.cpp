#include "hmi_web/notify/curl_sender.h"

#include <curl/curl.h>
#include <fmt/chrono.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "hmi_web/notify/codes.h"
#include "hmi_web/notify/message.h"

namespace stepwright::notify {
namespace {

constexpr long kOk = 200;
constexpr long kMultipleChoices = 300;
// So much of an answer is read.
constexpr std::size_t kMostAnswerBytes = 16 * 1'024;
// So much of a refusal is told.
constexpr std::size_t kLongestRefusal = 300;

struct EndEasy {
  void operator()(CURL* easy) const { curl_easy_cleanup(easy); }
};
struct EndList {
  void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
using Easy = std::unique_ptr<CURL, EndEasy>;
using List = std::unique_ptr<curl_slist, EndList>;

void append(List& list, const std::string& text) {
  curl_slist* longer = curl_slist_append(list.get(), text.c_str());
  if (longer == nullptr) return;
  static_cast<void>(list.release());
  list.reset(longer);
}

struct Upload {
  std::string_view rest;
};

std::size_t read_upload(char* into, std::size_t size, std::size_t count, void* from) {
  auto& upload = *static_cast<Upload*>(from);
  const std::size_t bytes = std::min(size * count, upload.rest.size());
  std::memcpy(into, upload.rest.data(), bytes);
  upload.rest.remove_prefix(bytes);
  return bytes;
}

// What the other side answers is of no use here, and it may have no end.
struct AnswerSize {
  std::size_t bytes = 0;
  bool too_long = false;
};

std::size_t skip_answer(char*, std::size_t size, std::size_t count, void* into) {
  auto& answer = *static_cast<AnswerSize*>(into);
  answer.bytes += size * count;
  answer.too_long = answer.bytes > kMostAnswerBytes;
  return answer.too_long ? CURL_WRITEFUNC_ERROR : size * count;
}

// What a mail server has refused last: its code and its words, of all lines ("550-5.1.1 no such user").
struct Refusal {
  std::string text;
  bool goes_on = false;  // the line before said that this one belongs to it
};

std::size_t hear_server(char* from, std::size_t size, std::size_t count, void* into) {
  auto& refusal = *static_cast<Refusal*>(into);
  std::string_view line(from, size * count);
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (line.starts_with("221")) return size * count;  // the end of the session
  if (!refusal.goes_on) refusal.text.clear();
  if (line.size() >= 3 && (line[0] == '4' || line[0] == '5')) {
    const std::string_view words =
        refusal.text.empty() ? line : line.substr(std::min<std::size_t>(4, line.size()));
    if (!refusal.text.empty()) refusal.text += ' ';
    for (const char c : words.substr(0, kLongestRefusal - std::min(kLongestRefusal, refusal.text.size())))
      refusal.text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  refusal.goes_on = line.size() > 3 && line[3] == '-';
  return size * count;
}

int ask_to_go_on(void* stop, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return static_cast<const std::stop_token*>(stop)->stop_requested() ? 1 : 0;
}

std::string random_id() {
  std::array<unsigned char, 16> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 2 * 16 + 1> text{};
  return sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
}

// RFC 5322, in UTC.
std::string date_now() {
  return fmt::format("{:%a, %d %b %Y %T} +0000", fmt::gmtime(std::time(nullptr)));
}

std::string address_of(const Channel& channel) {
  return channel.is_mail() ? channel.server : channel.web_hook;
}

// Scheme, host and port: a web hook's path may be a secret.
std::string shown(const std::string& address) {
  const std::size_t host = address.find("://");
  return host == std::string::npos ? address : address.substr(0, address.find('/', host + 3));
}

std::string hint_of(CURLcode code) {
  switch (code) {
    case CURLE_COULDNT_RESOLVE_HOST:
      return "does this machine know the name?";
    case CURLE_COULDNT_CONNECT:
    case CURLE_OPERATION_TIMEDOUT:
      return "is the server running, and does a firewall let this machine reach its port?";
    case CURLE_LOGIN_DENIED:
      return "user and password_file of the channel";
    case CURLE_USE_SSL_FAILED:
      return "the server offers no TLS; tls = false sends without it, for everybody on the way to read";
    case CURLE_PEER_FAILED_VERIFICATION:
      return "the server's certificate is not one that this machine trusts";
    default:
      return {};
  }
}

}  // namespace

CurlSender::CurlSender() {
  curl_global_init(CURL_GLOBAL_DEFAULT);
}
CurlSender::~CurlSender() {
  curl_global_cleanup();
}

result::Result<void> CurlSender::send(const Channel& channel, const Message& message,
                                      const std::stop_token& stop) {
  const Easy easy(curl_easy_init());
  if (!easy) return result::fail(kNotSent, {}, "there is no memory to send it");
  CURL* at = easy.get();
  std::array<char, CURL_ERROR_SIZE> why{};
  curl_easy_setopt(at, CURLOPT_ERRORBUFFER, why.data());
  curl_easy_setopt(at, CURLOPT_URL, address_of(channel).c_str());
  curl_easy_setopt(at, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(at, CURLOPT_CONNECTTIMEOUT, static_cast<long>(kLongestConnect.count()));
  curl_easy_setopt(at, CURLOPT_TIMEOUT, static_cast<long>(kLongest.count()));
  curl_easy_setopt(at, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(at, CURLOPT_XFERINFOFUNCTION, ask_to_go_on);
  curl_easy_setopt(at, CURLOPT_XFERINFODATA, &stop);
  AnswerSize answer;
  curl_easy_setopt(at, CURLOPT_WRITEFUNCTION, skip_answer);
  curl_easy_setopt(at, CURLOPT_WRITEDATA, &answer);
  if (!channel.user.empty()) {
    curl_easy_setopt(at, CURLOPT_USERNAME, channel.user.c_str());
    curl_easy_setopt(at, CURLOPT_PASSWORD, channel.password.c_str());
  }
  std::string text;
  Upload upload;
  List list;
  Refusal refusal;
  if (channel.is_mail()) {
    text = mail_of(channel, message, date_now(), random_id() + "@stepwright");
    upload.rest = text;
    for (const std::string& each : channel.to) append(list, "<" + each + ">");
    curl_easy_setopt(at, CURLOPT_PROTOCOLS_STR, "smtp,smtps");
    curl_easy_setopt(at, CURLOPT_USE_SSL, channel.needs_tls ? CURLUSESSL_ALL : CURLUSESSL_NONE);
    curl_easy_setopt(at, CURLOPT_MAIL_FROM, ("<" + channel.from + ">").c_str());
    curl_easy_setopt(at, CURLOPT_MAIL_RCPT, list.get());
    curl_easy_setopt(at, CURLOPT_READFUNCTION, read_upload);
    curl_easy_setopt(at, CURLOPT_READDATA, &upload);
    curl_easy_setopt(at, CURLOPT_UPLOAD, 1L);
    curl_easy_setopt(at, CURLOPT_HEADERFUNCTION, hear_server);
    curl_easy_setopt(at, CURLOPT_HEADERDATA, &refusal);
  } else {
    append(list, "Content-Type: application/json");
    if (channel.user.empty() && !channel.password.empty())
      append(list, "Authorization: Bearer " + channel.password);
    curl_easy_setopt(at, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(at, CURLOPT_HTTPHEADER, list.get());
    curl_easy_setopt(at, CURLOPT_POSTFIELDSIZE, static_cast<long>(message.json.size()));
    curl_easy_setopt(at, CURLOPT_POSTFIELDS, message.json.c_str());
  }
  const CURLcode done = curl_easy_perform(at);
  const std::string where = shown(address_of(channel));
  // Of a web hook the status is all that counts, and it comes first.
  const bool heard_enough = answer.too_long && !channel.is_mail();
  if (done != CURLE_OK && !heard_enough) {
    std::string said = why[0] != '\0' ? why.data() : curl_easy_strerror(done);
    if (!refusal.text.empty()) said = "the server said \"" + refusal.text + "\" (" + said + ")";
    return result::fail(kNotSent, {}, where + ": " + said, hint_of(done));
  }
  long status = 0;
  curl_easy_getinfo(at, CURLINFO_RESPONSE_CODE, &status);
  if (!channel.is_mail() && (status < kOk || status >= kMultipleChoices))
    return result::fail(kNotSent, {}, where + ": answers with status " + std::to_string(status),
                        "a web hook answers with 200 to 299");
  return {};
}

}  // namespace stepwright::notify

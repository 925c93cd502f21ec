#pragma once

// A client of an MQTT 3.1.1 broker (libmosquitto): connects on a thread of its own, and again with growing
// pauses whenever the connection is lost; what it has subscribed to stays subscribed.
//
// Any thread may call; messages that came are taken by one. Move-only. The destructor ends the connection as
// the protocol has it, so that the broker does not send the last will.
//
//   auto client = mqtt::Client::open({.host = "127.0.0.1", .port = 1883, .client_id = "master"});
//   client->subscribe("uagv/v2/+/+/state", 0);
//   for (const mqtt::Message& message : client->take(100ms)) ...

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::mqtt {

// Last will of MQTT: the message that the broker publishes when it loses this client.
struct Will {
  std::string topic;
  std::string payload;
  int qos = 1;
  bool retained = true;
};

struct Tls {
  std::string ca_file;           // PEM; the authorities that are trusted; empty: those of the system
  std::string certificate_file;  // PEM, of this client; empty: none
  std::string key_file;
};

struct Options {
  std::string host = "127.0.0.1";
  std::uint16_t port = 1883;
  std::string client_id{};  // unique at the broker
  std::string user{};       // empty: none
  std::string password{};
  std::chrono::seconds keep_alive{15};
  std::chrono::seconds reconnect_least{1};  // between attempts, doubled up to the most
  std::chrono::seconds reconnect_most{30};
  std::size_t most_waiting = 10'000;  // messages that came and were not taken; beyond, the oldest are dropped
  std::optional<Will> will{};
  std::optional<Tls> tls{};
};

struct Message {
  std::string topic;
  std::string payload;
  bool retained = false;
};

// Why there is no connection.
enum class TroubleKind : std::uint8_t {
  Unreachable,  // nobody listens there, or the connection broke: may pass
  NoHost,       // the name of the broker is not known
  Refused,      // by the broker: user, password, client id
  Tls,          // certificates and keys
};
struct Trouble {
  TroubleKind kind = TroubleKind::Unreachable;
  std::string text;
};

class Client {
 public:
  // MQ001: an option that the library refuses. MQ002: a file of TLS that cannot be read. An absent broker is
  // no fault: attempts go on, and `trouble` says why they fail.
  [[nodiscard]] static result::Result<Client> open(const Options& options);
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  bool connected() const;
  // Error of the last attempt; nothing while there is a connection, and before the first attempt ended.
  std::optional<Trouble> trouble() const;
  // How often a connection was made.
  std::size_t connections() const;
  // Messages that were dropped because nobody took them.
  std::size_t dropped() const;

  // Now and after every new connection.
  void subscribe(const std::string& filter, int qos);
  // False where it could not be handed over: not connected, or too large.
  bool publish(const std::string& topic, std::string_view payload, int qos, bool retained);
  // Waits until one is there, this long at most; in the order in which they came.
  std::vector<Message> take(std::chrono::milliseconds wait);

 private:
  class Connection;
  explicit Client(std::unique_ptr<Connection> connection);

  std::unique_ptr<Connection> connection_;
};

}  // namespace stepwright::mqtt

#pragma once

// The broker of a command line: address, user and password out of a file, certificates.
//
// Codes: MQ003 an address that is none, or with a password in it; MQ002 a file that cannot be read; C0001 to
// C0006 what is wrong in the credentials, with file, line and column; MQ004 (warning) credentials that others
// may read.
//
//   auto broker = broker_of({.url = "mqtts://broker.plant:8883", .ca_file = "ca.pem"});

#include <string>

#include "runtime/ground/mqtt/client.h"
#include "runtime/ground/result/result.h"

namespace stepwright::vda5050_link {

struct BrokerArguments {
  std::string url;                 // mqtt://HOST[:PORT] or mqtts://HOST[:PORT]
  std::string credentials_file{};  // TOML: user, password; empty: none
  std::string ca_file{};           // PEM; empty: the authorities of the system
  std::string certificate_file{};
  std::string key_file{};
};

struct Broker {
  mqtt::Options options;  // without client id and last will
  result::Diagnostics warnings;
};

[[nodiscard]] result::Result<Broker> broker_of(const BrokerArguments& arguments);

// Why no connection came about, for people, with the broker's address.
result::Diagnostic explain(const mqtt::Trouble& trouble, const mqtt::Options& broker);

}  // namespace stepwright::vda5050_link

// The requests that a monitor client makes, as the seed decides, and the checks of their replies.
// Independent of the transport: JSON lines or WebSocket.
#pragma once

#include <memory>
#include <string>

#include "tests/seeds/client.hpp"
#include "tests/seeds/messages.hpp"

namespace xr3::seeds {

class Requests {
 public:
  Requests(World& world, int number);

  /// A request as JSON, or something invalid that has a reply, too.
  std::string next();
  Messages& messages() { return messages_; }

 private:
  std::string ping();
  std::string get();
  std::string subscribe();
  std::string unsubscribe();
  std::string call(const std::string& function, const std::string& arguments);
  std::string look();
  std::string send();
  std::string change();
  std::string invalid();
  std::string new_id(const std::string& reply);
  std::string channel();

  World& world_;
  Random& random_;
  int number_;
  int count_ = 0;
  std::string id_;  ///< of the last request
  Messages messages_;
  std::unique_ptr<Reference> alone_;  ///< nothing but the line of this client
};

}  // namespace xr3::seeds

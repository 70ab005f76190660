// A session that takes part in the service: it is greeted, its requests are carried out, and its
// end closes the lines that it has opened.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/net/asio.hpp"
#include "server/service/service.hpp"
#include "server/session/session.hpp"

namespace xr3 {

class OpenSession final : public MonitorSession {
 public:
  /// Sends `hello`. The service must outlive the session; otherwise as MonitorSession.
  OpenSession(MonitorService& service, MessageSink& sink, const asio::ip::address& machine = {},
              std::optional<std::string> chosen = std::nullopt);
  ~OpenSession();  // NOLINT(bugprone-exception-escape): as in the definition

  /// Carries out one message at a time, and queues its answer. A transport reads the next message
  /// only while the client's queue has room.
  asio::awaitable<void> handle(std::string_view message);

 private:
  MonitorService& service_;
};

}  // namespace xr3

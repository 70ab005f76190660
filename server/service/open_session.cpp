#include "server/service/open_session.hpp"

#include <utility>

namespace xr3 {

OpenSession::OpenSession(MonitorService& service, MessageSink& sink,
                         const asio::ip::address& machine, std::optional<std::string> chosen)
    : MonitorSession(sink, machine, service.sessions().first_access(), std::move(chosen)),
      service_(service) {
  send(service_.sessions().hello(*this));
  service_.sessions().add(*this);  // last: if anything throws, the session is not registered
}

// NOLINTNEXTLINE(bugprone-exception-escape): remove() throws only without memory for its caller
OpenSession::~OpenSession() { service_.sessions().remove(*this); }

asio::awaitable<void> OpenSession::handle(std::string_view message) {
  if (auto refusal = service_.refuse(*this, message)) {
    send(std::move(refusal));
  } else if (auto request = client().accept(co_await service_.read(message))) {
    co_await service_.carry_out(*this, *std::move(request));
  }
  wake();
}

}  // namespace xr3

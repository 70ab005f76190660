// Acknowledges received bytes at once. The kernel delays an acknowledgement by 40 ms, so that it
// can go with a reply; a peer without TCP_NODELAY sends its next bytes only after it (the algorithm
// of Nagle, RFC 9293, section 3.7.4).
#pragma once

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace xr3 {

/// Acknowledges the received bytes of a TCP connection. Call after each read that causes no reply:
/// the option does not persist.
inline void acknowledge_received(int descriptor) {
  constexpr int kYes = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_QUICKACK, &kYes, sizeof kYes);
}

}  // namespace xr3

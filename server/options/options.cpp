#include "server/options/options.hpp"

#include "server/net/asio.hpp"

namespace xr3 {

bool is_loopback(const std::string& address) {
  ErrorCode error;
  return address == "localhost" || asio::ip::make_address(address, error).is_loopback();
}

}  // namespace xr3

// An answer to an HTTP request as a value, and the errors that are answered. It knows no bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http_wire.hpp"

namespace xr3::http {

struct Answer {
  unsigned status = 200;
  std::string type;  ///< of the body
  std::string body;
  std::vector<Field> fields;  ///< further ones
  Then then = Then::kKeep;
};

Answer text(std::string body);
Answer json(std::string body);

/// `{"error":{"code","message","hint"}}`. The code is stable, the words are for people.
Answer error(unsigned status, const char* code, const std::string& message,
             const std::string& hint);

inline constexpr const char* kRequestHint =
    "GET /healthz HTTP/1.1 with one Host, lines ended by CR LF";
/// 400, and the connection ends: what follows cannot be trusted.
Answer bad_request(const std::string& message, const std::string& hint = kRequestHint);
Answer not_found(const std::string& message);
/// 405; the connection ends, since a body may follow.
Answer method_not_allowed();
/// 403 where reading needs the token, which travels in JSON only.
Answer token_required();
/// 408: the head did not come in time.
Answer too_slow();
/// 503: as many connections are open as may be.
Answer full();

/// Why a head is refused; nothing where it is not.
std::optional<Answer> refuse_head(HeadFault fault);

/// The whole answer; without its body where a HEAD asks.
std::string to_bytes(const Answer& answer, std::string_view method);

}  // namespace xr3::http

// HTTP responses as values, and the error responses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http/body.hpp"
#include "server/http/wire.hpp"

namespace xr3::http {

struct Answer {
  unsigned status = 200;
  std::string type;  ///< Content-Type of the body
  Body body;
  std::vector<Field> fields;  ///< additional header fields
  Then then = Then::kKeep;
};

Answer text(Body body);
Answer json(Body body);

/// `{"error":{"code","message","hint"}}`. Only the code is stable; programs must not parse the
/// texts.
Answer error(unsigned status, const char* code, const std::string& message,
             const std::string& hint);

/// Closes the connection after this answer.
Answer closing(Answer answer);

inline constexpr const char* kRequestHint =
    "an example: GET /healthz HTTP/1.1 with one Host field; CR LF ends each line";
/// 400. Closes the connection, since the next request cannot be located reliably.
Answer bad_request(const std::string& message, const std::string& hint = kRequestHint);
Answer not_found(const std::string& message);
/// 405. Closes the connection, since a body may follow.
Answer method_not_allowed();
/// 403: reading requires the token, which only JSON messages can carry.
Answer token_required();
/// 401: reading the metrics requires their token; or it is another one, and the connection closes.
Answer metrics_token_required();
Answer bad_metrics_token();
/// 408: the head did not arrive in time.
Answer too_slow();
/// 503: the maximum number of connections is open.
Answer full();

/// The error response for a fault; nullopt for kNone.
std::optional<Answer> refuse_head(HeadFault fault);

/// The status line and the header fields as bytes.
std::string head_bytes(const Answer& answer);
/// The body to send: none if the method is HEAD. It exists as long as the answer.
std::string_view body_bytes(const Answer& answer, std::string_view method);
/// Both together, for small answers.
std::string to_bytes(const Answer& answer, std::string_view method);

}  // namespace xr3::http

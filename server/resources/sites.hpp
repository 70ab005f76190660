// The sites below a path of their own: the documentation, which scripts/site builds, below /docs/,
// and the robot without a server, which scripts/playground builds, below /play/. Their files come
// from the folders where they are installed. Independent of connections.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/http/answer.hpp"
#include "server/net/asio.hpp"
#include "server/net/worker.hpp"

namespace xr3 {

class Sites {
 public:
  /// The worker, which reads the files, must outlive it.
  explicit Sites(Worker& worker);

  /// Whether answer() is for requests of this path.
  static bool has(std::string_view path);

  /// The paths of the sites that are here now, such as `["/docs/"]`.
  asio::awaitable<http::Answer> list();

  /// The file with this path, which is not percent-decoded; a redirection if a folder lacks the
  /// slash at its end, or if the path is that of another site below this one; the error
  /// `not_found` for anything outside of the folder of the site, for what is no regular file, and
  /// for a file of more than 16 MiB. A file exists once, for however many clients it waits to be
  /// sent to. Precondition: has(path).
  asio::awaitable<http::Answer> answer(std::string path);

 private:
  class Files;

  Worker& worker_;
  std::shared_ptr<Files> files_;  ///< used in the worker only
};

}  // namespace xr3

// The documentation as a site, below /docs/: the files that scripts/site builds, from the folder
// where they are installed. Independent of connections.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/http/answer.hpp"
#include "server/net/asio.hpp"
#include "server/net/worker.hpp"

namespace xr3 {

class Documentation {
 public:
  /// The worker, which reads the files, must outlive it.
  explicit Documentation(Worker& worker);

  /// Whether answer() is for requests of this path.
  static bool has(std::string_view path);

  /// The file with this path, which is not percent-decoded; a redirection if a folder lacks the
  /// slash at its end; the error `not_found` for anything outside of the folder of the site, for
  /// what is no regular file, and for a file of more than 4 MiB. A file exists once, for however
  /// many clients it waits to be sent to. Precondition: has(path).
  asio::awaitable<http::Answer> answer(std::string path);

 private:
  class Site;

  Worker& worker_;
  std::shared_ptr<Site> site_;  ///< used in the worker only
};

}  // namespace xr3

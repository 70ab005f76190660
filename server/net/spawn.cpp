#include "server/net/spawn.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <utility>

#include "cell/failure.hpp"

namespace xr3 {
namespace {

// Ends a session; an exception thrown by a completion handler leaves io_context::run().
void end_session(const char* name, const std::exception_ptr& failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const FatalFailure&) {
    fail_fatally(name, failure);
  } catch (const std::exception& error) {
    spdlog::error("{}: a connection has failed and is closed: {}", name, error.what());
  } catch (...) {
    spdlog::error("{}: a connection has failed and is closed: an exception of unknown type", name);
  }
}

}  // namespace

void spawn_loop(const asio::any_io_executor& executor, const char* name,
                asio::awaitable<void> loop) {
  asio::co_spawn(executor, std::move(loop), [name](const std::exception_ptr& failure) {
    if (failure) fail_fatally(name, failure);
  });
}

void spawn_session(const asio::any_io_executor& executor, const char* name,
                   asio::awaitable<void> session, std::function<void()> ended) {
  asio::co_spawn(executor, std::move(session),
                 [name, ended = std::move(ended)](const std::exception_ptr& failure) {
                   end_session(name, failure);
                   ended();
                 });
}

}  // namespace xr3

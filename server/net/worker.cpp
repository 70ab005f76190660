#include "server/net/worker.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <boost/system/system_error.hpp>

namespace xr3 {
namespace {

constexpr int kNice = 10;

// On Linux a thread has its own nice value. If the system refuses, the priority stays.
void lower_priority() {
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice));
}

}  // namespace

bool Worker::start() {
  if (thread_) return true;
  try {
    asio::post(thread_.emplace(), lower_priority);
  } catch (const boost::system::system_error& error) {
    spdlog::warn("long work is done in the event loop, since no thread can be started: {}",
                 error.what());
  }
  return thread_.has_value();
}

void Worker::stop() {
  if (!thread_) return;
  thread_->stop();
  thread_->join();
  thread_->shutdown();
}

}  // namespace xr3

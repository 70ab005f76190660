#include "server/net/worker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/post.hpp>

namespace xr3 {
namespace {

constexpr int kNice = 10;

// On Linux a thread has its own nice value. If the system refuses, the priority stays.
void lower_priority() {
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice));
}

}  // namespace

Worker::Worker() { asio::post(thread_, lower_priority); }

void Worker::stop() {
  thread_.stop();
  thread_.join();
  thread_.shutdown();
}

}  // namespace xr3

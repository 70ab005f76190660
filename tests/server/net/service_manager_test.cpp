// The reports to a service manager: what is sent to its socket, when, and from which environment.
#include "server/net/service_manager.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace xr3 {
namespace {

using namespace std::chrono_literals;

/// A socket like that of the manager, with an abstract name.
class Manager {
 public:
  Manager() : file_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    ::sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name_.copy(address.sun_path + 1, name_.size());
    const auto length =
        static_cast<::socklen_t>(offsetof(::sockaddr_un, sun_path) + 1 + name_.size());
    EXPECT_EQ(::bind(file_, reinterpret_cast<const ::sockaddr*>(&address), length), 0);
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;
  ~Manager() { ::close(file_); }

  std::string socket() const { return "@" + name_; }
  /// The messages that have arrived since the last call.
  std::vector<std::string> received() const {
    std::vector<std::string> all;
    std::array<char, 64> bytes{};
    for (;;) {
      const ::ssize_t count = ::recv(file_, bytes.data(), bytes.size(), 0);
      if (count < 0) return all;
      all.emplace_back(bytes.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  std::string name_ = "xr3-unit-test-" + std::to_string(::getpid());
  int file_;
};

class ServiceManagerTest : public testing::Test {
 protected:
  /// Sets variables of the environment; empty: unset.
  static void set(const std::string& socket, const std::string& time, const std::string& process) {
    const auto put = [](const char* name, const std::string& value) {
      value.empty() ? ::unsetenv(name) : ::setenv(name, value.c_str(), 1);
    };
    put("NOTIFY_SOCKET", socket);
    put("WATCHDOG_USEC", time);
    put("WATCHDOG_PID", process);
  }
  void TearDown() override { set("", "", ""); }

  ServiceManager service(std::optional<std::chrono::microseconds> watchdog) {
    return {io_, {manager_.socket(), watchdog}};
  }
  /// Runs the loop until this many messages have arrived.
  std::vector<std::string> run_until(std::size_t messages) {
    std::vector<std::string> all;
    while (all.size() < messages && io_.run_one() > 0)
      for (std::string& each : manager_.received()) all.push_back(std::move(each));
    return all;
  }

  asio::io_context io_{1};
  Manager manager_;
};

using Texts = std::vector<std::string>;

TEST_F(ServiceManagerTest, ReportsReadyAndStopping) {
  ServiceManager service = this->service({});
  EXPECT_EQ(manager_.received(), Texts{});
  service.ready();
  EXPECT_EQ(manager_.received(), Texts{"READY=1"});
  EXPECT_EQ(io_.run(), 0U) << "no watchdog was asked for";
  service.stopping();
  EXPECT_EQ(manager_.received(), Texts{"STOPPING=1"});
}

TEST_F(ServiceManagerTest, ShowsLifeUntilTheStop) {
  ServiceManager service = this->service(40ms);
  service.ready();
  EXPECT_EQ(run_until(3), (Texts{"READY=1", "WATCHDOG=1", "WATCHDOG=1"}));
  service.stopping();
  io_.run();
  EXPECT_EQ(manager_.received(), Texts{"STOPPING=1"});
}

TEST_F(ServiceManagerTest, ShowsLifeWhenThePostHasRun) {
  ServiceManager service = this->service(20ms);
  service.ready();
  io_.run_one_for(1s);  // starts the timer
  EXPECT_EQ(manager_.received(), Texts{"READY=1"});
  io_.run_one_for(1s);  // the timer fires
  EXPECT_EQ(manager_.received(), Texts{}) << "handlers that are ready run first";
  io_.run_one_for(1s);
  EXPECT_EQ(manager_.received(), Texts{"WATCHDOG=1"});
  service.stopping();
  io_.run();
}

TEST_F(ServiceManagerTest, WithoutAManagerNothingHappens) {
  ServiceManager service(io_, {"", 40ms});
  service.ready();
  EXPECT_EQ(io_.run(), 0U);
  service.stopping();
}

TEST_F(ServiceManagerTest, ReadsTheEnvironment) {
  set("/run/notify", "30000000", std::to_string(::getpid()));
  EXPECT_EQ(service_environment().socket, "/run/notify");
  EXPECT_EQ(service_environment().watchdog, 30s);
  set("@abstract", "30000000", "");
  EXPECT_EQ(service_environment().socket, "@abstract");
  EXPECT_EQ(service_environment().watchdog, 30s);
  set("", "", "");
  EXPECT_EQ(service_environment().socket, "");
  EXPECT_FALSE(service_environment().watchdog);
}

TEST_F(ServiceManagerTest, IgnoresValuesThatMakeNoSense) {
  for (const std::string time : {"0", "-5", "5s", "99999999999999999999"}) {
    set("@abstract", time, "");
    EXPECT_FALSE(service_environment().watchdog) << time;
  }
  set("@abstract", "1000", "1");
  EXPECT_FALSE(service_environment().watchdog) << "of another process";
  for (const std::string& socket : {std::string("relative"), "/" + std::string(200, 'x')}) {
    set(socket, "", "");
    EXPECT_EQ(service_environment().socket, "") << socket;
  }
}

}  // namespace
}  // namespace xr3

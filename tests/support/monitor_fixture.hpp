// A fixture for tests of the monitor's service: a cell with a manual clock, and a session without a
// connection, whose output the test reads.
#pragma once

#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "server/net/wall_clock.hpp"
#include "server/service/open_session.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3::test {

/// A sink without a connection: the tests read the output of the session themselves.
struct NullSink final : MessageSink {
  void pump() override {}
};

class MonitorFixture : public testing::Test {
 protected:
  explicit MonitorFixture(AccessPolicy policy = {}) : policy_(std::move(policy)) {}

  /// Passes a message to the session; returns all output.
  std::vector<Json> ask(OpenSession& session, const std::string& message) {
    begin(session, message);
    io_.restart();
    io_.poll();
    return read(session);
  }
  /// Expects exactly one message as the answer and returns it.
  Json answer(OpenSession& session, const std::string& message) {
    const std::vector<Json> answers = ask(session, message);
    EXPECT_EQ(answers.size(), 1U) << message;
    return answers.empty() ? Json() : answers.front();
  }
  Json call(OpenSession& session, const std::string& fn, const std::string& args = "{}") {
    return answer(session, R"({"op":"call","id":1,"fn":")" + fn + R"(","args":)" + args + "}");
  }
  /// Passes a message to the session, and does not wait for its answer.
  void begin(OpenSession& session, const std::string& message) {
    asio::co_spawn(
        io_, [&session, message] { return session.handle(message); }, asio::detached);
  }
  std::vector<Json> read(MonitorSession& session) {
    std::vector<Json> messages;
    while (const monitor::Message message = session.next_output())
      messages.push_back(Json::parse(*message));
    return messages;
  }
  /// Runs the loop until there is output.
  std::vector<Json> wait(MonitorSession& session) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (;;) {
      std::vector<Json> messages = read(session);
      if (!messages.empty() || std::chrono::steady_clock::now() > deadline) return messages;
      io_.restart();
      io_.run_one_for(std::chrono::milliseconds(20));
    }
  }
  void send(const std::string& bytes) {
    if (line_ == 0) line_ = cell_.apply(LineOpened{"test"}, wall_now()).line;
    cell_.apply(BytesIn{line_, bytes}, wall_now());
    hosted_.after_input();
  }

  asio::io_context io_{1};
  CellHost host_{io_};
  HostedCell& hosted_ = host_.add(rhino());
  Cell& cell_ = hosted_.cell();
  AccessPolicy policy_;
  MonitorService service_{io_, host_.cells, host_.worker, policy_};
  NullSink sink_;
  OpenSession one_{service_, sink_};
  LineId line_ = 0;
};

}  // namespace xr3::test

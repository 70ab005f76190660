// A fixture for tests of service/: a cell with a manual clock, and its monitor without a server.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cell/history/history.hpp"
#include "service/cell_monitor.hpp"
#include "tests/support/models.hpp"

namespace xr3::test {

class CellMonitorFixture : public testing::Test {
 protected:
  CellMonitorFixture() { read(); }

  /// Passes a message to the monitor; returns all output.
  std::vector<Json> ask(const std::string& message) {
    monitor_.handle(message, now_);
    return read();
  }
  /// Expects exactly one message as the answer and returns it.
  Json answer(const std::string& message) {
    const std::vector<Json> answers = ask(message);
    EXPECT_EQ(answers.size(), 1U) << message;
    return answers.empty() ? Json() : answers.front();
  }
  Json call(const std::string& fn, const std::string& args = "{}") {
    return answer(R"({"op":"call","id":1,"fn":")" + fn + R"(","args":)" + args + "}");
  }
  std::vector<Json> read() {
    std::vector<Json> messages;
    while (const monitor::Message message = monitor_.next_output(now_))
      messages.push_back(Json::parse(*message));
    return messages;
  }
  /// Lets a second of wall time pass, and returns what the client gets then.
  std::vector<Json> wait() {
    now_ += 1'000'000'000;
    monitor_.offer_frames(now_);
    return read();
  }

  WallNs now_ = 0;
  monitor::ByteBudget memory_{std::size_t{16} * 1024 * 1024};
  std::shared_ptr<Cell> cell_ = std::make_shared<Cell>("main", rhino(), SimClock::manual());
  History history_{*cell_, 60 * kTickHz, memory_};
  service::CellMonitor monitor_{"xr3 test", cell_, &history_};
};

}  // namespace xr3::test

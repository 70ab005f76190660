// A fixture for tests of line sessions: a cell, and sessions on streams that the test provides.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "server/lines/turns.hpp"
#include "tests/support/models.hpp"

namespace xr3::test {

class LineFixture : public testing::Test {
 protected:
  /// A source that accepts no clients.
  struct NoSource final : LineSource {
    void accept_arrived() override {}
    void line_ended(LineId, LineCloseReason) override {}
  };

  std::shared_ptr<LineSession> open(std::unique_ptr<LineStream> stream,
                                    PeerCounts::Place place = nullptr) {
    return std::make_shared<LineSession>(std::move(stream), LineOpened{}, context_, source_,
                                         std::move(place));
  }

  asio::io_context io_{1};
  LineTurns turns_{io_};
  Cell cell_{"main",
             std::make_shared<const Model>(robot_named("rhino-xr3"), workcell_named("rhino-xr3"),
                                           Profile::kPaper),
             SimClock::manual()};
  std::vector<LineCloseReason> ended_;  ///< of the sessions that have ended, in order
  LineSessionContext context_{cell_, turns_, [](LineId) {},
                              [this](LineId, LineCloseReason reason) { ended_.push_back(reason); }};
  NoSource source_;
};

}  // namespace xr3::test

#include "server/lines/session.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <utility>
#include <vector>

#include "tests/support/line_sessions.hpp"
#include "tests/support/scripted_stream.hpp"

namespace xr3 {
namespace {

using test::accepts;
using test::fails_to_read;
using test::fails_to_write;
using test::reads;
using test::reads_end;
using test::StreamStep;
using Turn = LineSession::Turn;
using Reasons = std::vector<LineCloseReason>;

class LineSessionTest : public test::LineFixture {
 protected:
  void open(std::deque<StreamStep> script) {
    auto stream = std::make_unique<test::ScriptedStream>(std::move(script));
    stream_ = stream.get();
    session_ = LineFixture::open(std::move(stream));
  }
  /// A turn that no time ends.
  Turn turn() { return session_->run_turn(kNever / 2); }
  std::size_t held_bytes() const { return session_->held_bytes(); }

  std::shared_ptr<LineSession> session_;
  test::ScriptedStream* stream_ = nullptr;
};

TEST_F(LineSessionTest, AnInquiryIsAnsweredInItsTurn) {
  open({reads("E?"), accepts(" ")});
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_TRUE(stream_->is_done());
}

TEST_F(LineSessionTest, TheFirstBytesAreReadTogetherAndLaterOnesTurnByTurn) {
  const std::string first(kFirstChunk, '\r');
  open({reads(first + std::string(LineSession::kBytesATurn + 1, '\r'))});
  EXPECT_EQ(turn(), Turn::kMore);
  EXPECT_EQ(session_->bytes_in(), kFirstChunk);
  EXPECT_EQ(session_->arrived_bytes(), LineSession::kBytesATurn + 1);
  EXPECT_EQ(turn(), Turn::kMore);
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_EQ(session_->arrived_bytes(), 0U);
}

TEST_F(LineSessionTest, AClientThatReadsNoRepliesBlocksItsLine) {
  open({reads("E?E?E?"), accepts(" "), accepts(""), accepts(""), accepts("  "), reads("E?"),
        accepts(" ")});
  EXPECT_EQ(turn(), Turn::kBlocked);
  EXPECT_EQ(held_bytes(), 2U);
  EXPECT_EQ(turn(), Turn::kBlocked);
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_TRUE(stream_->is_done());
}

TEST_F(LineSessionTest, TheEndOfTheStreamClosesTheLineAfterItsReplies) {
  open({reads("E?"), accepts(" "), reads_end()});
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_EQ(turn(), Turn::kBlocked);
  EXPECT_EQ(ended_, Reasons{LineCloseReason::kClientClosed});
  EXPECT_EQ(cell_.find_line(session_->line()), nullptr);
}

TEST_F(LineSessionTest, EachFailureClosesTheLineAtOnce) {
  const std::deque<StreamStep> whole = {reads("E?"), accepts(" "), reads("E?"), accepts(" ")};
  for (std::size_t good = 0; good < whole.size(); ++good) {
    SCOPED_TRACE(good);
    std::deque<StreamStep> script(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(good));
    script.push_back(good % 2 == 0 ? fails_to_read() : fails_to_write());
    ended_.clear();
    open(std::move(script));
    for (int turns = 0; turns < 3 && session_->is_open(); ++turns) turn();
    EXPECT_EQ(ended_, Reasons{LineCloseReason::kError});
    EXPECT_EQ(turn(), Turn::kBlocked) << "no access to a closed stream";
  }
}

TEST_F(LineSessionTest, ABrowserIsDisconnectedWithoutAByte) {
  open({reads("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")});
  EXPECT_EQ(turn(), Turn::kBlocked);
  EXPECT_EQ(ended_, Reasons{LineCloseReason::kNotARobotProgram});
}

TEST_F(LineSessionTest, FinishSendsTheRepliesAndReadsNoMore) {
  open({reads("E?E?"), accepts(""), accepts("  "), reads("E+50\r")});
  EXPECT_EQ(turn(), Turn::kBlocked);
  session_->finish();
  EXPECT_EQ(ended_, Reasons{LineCloseReason::kShutdown});
  EXPECT_FALSE(stream_->is_done()) << "the last bytes are not read";
}

TEST_F(LineSessionTest, TheRepliesOfAFrozenCellWait) {
  cell_.apply(Input{call::Call{call::Freeze{}}}, 0);
  open({reads("E?"), accepts(" "), reads("E?"), accepts(" ")});
  EXPECT_EQ(turn(), Turn::kBlocked);
  EXPECT_EQ(held_bytes(), 1U);
  EXPECT_EQ(turn(), Turn::kBlocked) << "further bytes are not read";
  cell_.apply(Input{call::Call{call::Unfreeze{}}}, 0);
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_EQ(turn(), Turn::kDrained);
  EXPECT_TRUE(stream_->is_done());
}

TEST_F(LineSessionTest, AFrozenCellEndsWithItsServer) {
  cell_.apply(Input{call::Call{call::Freeze{}}}, 0);
  open({reads("E?"), accepts(" ")});
  EXPECT_EQ(turn(), Turn::kBlocked);
  session_->finish();
  EXPECT_EQ(ended_, Reasons{LineCloseReason::kShutdown});
  EXPECT_TRUE(stream_->is_done());
}

TEST_F(LineSessionTest, AClosedSessionStaysClosed) {
  open({reads("E?")});
  session_->close(LineCloseReason::kDisconnected);
  session_->close(LineCloseReason::kError);
  EXPECT_EQ(ended_, Reasons{LineCloseReason::kDisconnected});
  EXPECT_EQ(session_->arrived_bytes(), 0U);
  EXPECT_EQ(held_bytes(), 0U);
}

}  // namespace
}  // namespace xr3

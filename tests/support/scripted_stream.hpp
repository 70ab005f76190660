// A stream that expects reads and writes in a given order and has a result for each. A read beyond
// the script gives nothing; a write that it does not expect is a failure of the test.
#pragma once

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <string>

#include "server/lines/stream.hpp"

namespace xr3::test {

struct StreamStep {
  enum class Kind : std::uint8_t { kRead, kReadEnd, kReadError, kWrite, kWriteError, kFull };
  Kind kind;
  std::string bytes = {};  ///< that are read, or accepted by the write
};

inline StreamStep reads(std::string bytes) { return {StreamStep::Kind::kRead, std::move(bytes)}; }
inline StreamStep accepts(std::string bytes) {
  return {StreamStep::Kind::kWrite, std::move(bytes)};
}
inline StreamStep reads_end() { return {StreamStep::Kind::kReadEnd}; }
/// The last step: accepts no byte any more.
inline StreamStep is_full() { return {StreamStep::Kind::kFull}; }
inline StreamStep fails_to_read() { return {StreamStep::Kind::kReadError}; }
inline StreamStep fails_to_write() { return {StreamStep::Kind::kWriteError}; }

class ScriptedStream final : public LineStream {
 public:
  explicit ScriptedStream(std::deque<StreamStep> script) : script_(std::move(script)) {}
  ScriptedStream(const ScriptedStream&) = delete;
  ScriptedStream& operator=(const ScriptedStream&) = delete;
  ~ScriptedStream() override { ::close(descriptor_); }

  int descriptor() const override { return is_closed_ ? -1 : descriptor_; }
  std::size_t unread_bytes() const override {
    return next_is(StreamStep::Kind::kRead) ? script_.front().bytes.size() : 0;
  }
  void close() override { is_closed_ = true; }

  std::size_t read(std::span<char> into) override {
    EXPECT_FALSE(is_closed_) << "read after close";
    if (next_is(StreamStep::Kind::kReadEnd)) set_ended();
    if (next_is(StreamStep::Kind::kReadError)) set_lost();
    if (has_ended() || is_lost() || !next_is(StreamStep::Kind::kRead)) return 0;
    std::string& bytes = script_.front().bytes;
    const std::size_t count = std::min(into.size(), bytes.size());
    std::ranges::copy(bytes.substr(0, count), into.begin());
    bytes.erase(0, count);
    if (bytes.empty()) script_.pop_front();
    return count;
  }

  std::size_t write(std::string_view bytes) override {
    EXPECT_FALSE(is_closed_) << "write after close";
    if (next_is(StreamStep::Kind::kWriteError)) set_lost();
    if (is_lost() || next_is(StreamStep::Kind::kFull)) return 0;
    EXPECT_TRUE(next_is(StreamStep::Kind::kWrite)) << "a write of " << bytes;
    if (!next_is(StreamStep::Kind::kWrite)) return bytes.size();
    const std::string accepted = script_.front().bytes;
    script_.pop_front();
    EXPECT_EQ(bytes.substr(0, accepted.size()), accepted);
    return accepted.size();
  }

  /// Whether all steps have been taken.
  bool is_done() const { return script_.empty(); }

 private:
  bool next_is(StreamStep::Kind kind) const {
    return !script_.empty() && script_.front().kind == kind;
  }

  std::deque<StreamStep> script_;
  bool is_closed_ = false;
  int descriptor_ = ::eventfd(0, EFD_CLOEXEC);
};

}  // namespace xr3::test

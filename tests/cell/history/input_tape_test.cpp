#include "cell/history/input_tape.hpp"

#include <gtest/gtest.h>

#include "protocol/recording/entry_json.hpp"

namespace xr3 {
namespace {

using recording::Entry;
using recording::LineInput;

std::vector<std::string> texts_of(const InputTape& tape) {
  std::vector<std::string> texts;
  tape.for_each([&](const Entry& entry) {
    texts.push_back(members_of(entry, -1));
    return true;
  });
  return texts;
}

TEST(InputTape, GivesBackWhatWasAdded) {
  const std::vector<Entry> entries = {
      {2, 5, 0, recording::LineBegin{1, "127.0.0.1:5000", LineKind::kTcp, Guard::kStrict}},
      {2, 5, 999, LineInput{1, "E?", 2, 0, ""}},
      {2, 5, 0, LineInput{4'294'967'295, std::string(300, '\xff'), 3, 70'000, ""}},
      {2, 9'007'199'254'740'991, 1, LineInput{1, "", 0, 0, ""}},
      {2, 9'007'199'254'740'991, 1, recording::CallMade{call::Reset{}}},
      {3, 0, 1, LineInput{1, "I", 1, 127, ""}},
      {3, 128, 1, LineInput{1, "I", 1, 128, ""}},
      {3, 128, 1, recording::LineUnsent{1, 3}},
  };
  InputTape tape;
  std::vector<std::string> expected;
  for (const Entry& entry : entries) {
    tape.add(recording::Entry(entry));
    expected.push_back(members_of(entry, -1));
  }
  EXPECT_EQ(tape.size(), entries.size());
  EXPECT_EQ(texts_of(tape), expected);
}

TEST(InputTape, StopsWhenItIsTold) {
  InputTape tape;
  for (Tick tick = 0; tick < 10; ++tick) tape.add({0, tick, 0, LineInput{1, "E?", 2, 0, ""}});
  int used = 0;
  tape.for_each([&](const Entry& entry) {
    ++used;
    return entry.tick < 4;
  });
  EXPECT_EQ(used, 5);
}

TEST(InputTape, APollTakesLittle) {
  InputTape tape;
  constexpr std::size_t kPolls = 10'000;
  for (std::size_t i = 0; i < kPolls; ++i)
    tape.add({0, static_cast<Tick>(i * 50), 0, LineInput{1, "E?", 2, 0, ""}});
  EXPECT_LE(tape.bytes(), kPolls * 24);
}

TEST(InputTape, KnowsTheMemoryOfLargeCalls) {
  InputTape tape;
  Block block;
  block.name = std::string(1000, 'x');
  call::ReplaceWorkcell replace;
  replace.workcell.blocks.edit().assign(100, block);
  tape.add({0, 0, 0, recording::CallMade{replace}});
  EXPECT_GE(tape.bytes(), 100'000U);
}

}  // namespace
}  // namespace xr3

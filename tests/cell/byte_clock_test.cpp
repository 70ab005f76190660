#include "cell/byte_clock.hpp"

#include <gtest/gtest.h>

#include "core/home.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

TEST(ByteClock, KeepsTheRestOfATick) {
  ByteClock clock({});
  EXPECT_EQ(clock.take_ticks(999), 0);
  EXPECT_EQ(clock.take_ticks(1), 1);
  EXPECT_EQ(clock.take_ticks(2'500), 2);
  EXPECT_EQ(clock.remainder(), 500);
  clock.owe(700);
  EXPECT_EQ(clock.take_owed(), 700);
  EXPECT_EQ(clock.take_owed(), 0);
  clock.owe(1);
  clock.restart();
  EXPECT_EQ(clock.remainder(), 0);
  EXPECT_EQ(clock.take_owed(), 0);
}

TEST(ByteClock, ACharacterHasTheTimeOfTheLine) {
  EXPECT_EQ(ByteClock({}).character_time(std::nullopt), 1'146);
  const SerialSettings client{300, SerialFrame{8, Parity::kNone, StopBits::kOne}};
  EXPECT_EQ(ByteClock({}).character_time(client), 1'146) << "only auto follows the client";
  const ByteClock follower({}, LineSpeed{std::nullopt, Rate{}});
  EXPECT_EQ(follower.character_time(std::nullopt), 1'146);
  EXPECT_EQ(follower.character_time(client), 33'333);
  const ByteClock ten_times({}, LineSpeed{client, Rate{10'000'000}});
  EXPECT_EQ(ten_times.character_time(std::nullopt), 3'333);
  const ByteClock fastest({}, LineSpeed{client, kFastest});
  EXPECT_EQ(fastest.character_time(std::nullopt), 0);
}

TEST(ByteClock, KnowsInquiries) {
  for (const Command& command : std::initializer_list<Command>{
           QueryError{'E'}, QuerySignedError{'E'}, QuerySwitch{'E'}, QuerySwitchesI{},
           QuerySwitchesJ{}, QueryInputs{}, CameraImage{}, CameraRow{0}, CameraPixel{0, 0}})
    EXPECT_TRUE(is_inquiry(command)) << command.index();
  for (const Command& command :
       std::initializer_list<Command>{Move{'E', 1}, Stop{'E'}, SoftHome{}, SetOutput{1, true}})
    EXPECT_FALSE(is_inquiry(command)) << command.index();
}

TEST(ByteClock, HurryIsAMotionThatNobodyHasAskedAbout) {
  ByteClock clock({});
  const ModelPtr model = test::rhino();
  State state = initial_state(*model);
  const auto note = [&](const Command& command) {
    return clock.note_command(command, *model, state);
  };
  EXPECT_FALSE(note(Move{'E', 5}));
  state.motor(model->index_of('E')).error = 5;
  EXPECT_TRUE(note(Move{'E', 5}));
  EXPECT_FALSE(note(Move{'E', 5})) << "the run goes on";
  EXPECT_FALSE(note(QuerySwitchesI{}));
  EXPECT_FALSE(note(Stop{'E'})) << "it has asked";
  EXPECT_TRUE(note(Stop{'E'}));
  clock.restart();
  note(Move{'E', 5});
  state.motor(model->index_of('E')).blocked = Blocked::kLimit;
  EXPECT_FALSE(note(Move{'E', 5})) << "it cannot arrive";
  EXPECT_FALSE(note(Move{'G', 5})) << "no such joint";
}

TEST(ByteClock, WarnsOfTimesThatAreTooShort) {
  const ModelPtr model = test::rhino();
  EXPECT_FALSE(is_quicker_than_a_count(ByteClock({}), *model));
  EXPECT_TRUE(is_quicker_than_a_count(ByteClock({.inquiry_ms = 1}), *model));
  for (const char* shipped : {"rhino-xr3", "rhino-xr3-accessories", "adept-one", "intelledex-660"})
    EXPECT_FALSE(
        is_quicker_than_a_count(ByteClock({}), *test::model_of(test::robot_named(shipped))))
        << shipped;
}

}  // namespace
}  // namespace xr3

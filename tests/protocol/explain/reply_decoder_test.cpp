// Replies decoded from their bytes: the inverse of append_reply(), and bytes that are no reply.
#include "protocol/explain/reply_decoder.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/explain/command_text.hpp"
#include "protocol/line/rhino_reply.hpp"
#include "tests/support/models.hpp"
#include "tests/support/words.hpp"

namespace xr3 {
namespace {

ReplyContext context(Profile profile, std::optional<wire::PictureSize> camera = std::nullopt) {
  ReplyContext context;
  context.profile = profile;
  context.camera = camera;
  return context;
}

/// The text of decoded bytes; "no reply" if they are none.
std::string text_of_reply(const Command& command, std::string_view bytes,
                          const ReplyContext& context) {
  const auto answered = decode_reply(command, bytes, context);
  return answered ? reply_text(*answered, context).phrase : "no reply";
}

/// Encodes a reply, decodes its bytes, and expects the same reply.
template <class Value>
void expect_same(const Command& command, const Value& reply, const ReplyContext& context) {
  std::string bytes;
  append_reply(reply, context.profile, bytes);
  const auto answered = decode_reply(command, bytes, context);
  ASSERT_TRUE(answered) << test::words(Reply{reply});
  const auto* value = std::get_if<Value>(&answered->reply);
  ASSERT_NE(value, nullptr) << test::words(Reply{reply});
  EXPECT_EQ(*value, reply) << test::words(Reply{reply});
}

TEST(ReplyDecoder, InvertsTheEncoderInBothProfiles) {
  for (const Profile profile : {Profile::kPaper, Profile::kMark3}) {
    const ReplyContext both = context(profile);
    for (int counts = 0; counts <= 127; ++counts) {
      expect_same(QueryError{'E'}, ErrorMagnitude{counts}, both);
    }
    for (int counts = -128; counts <= 127; ++counts) {
      expect_same(QuerySignedError{'E'}, SignedError{static_cast<std::int8_t>(counts)}, both);
    }
    for (const bool is_on : {false, true}) {
      expect_same(QuerySwitch{'E'}, SwitchState{is_on}, both);
      expect_same(CameraPixel{0, 0}, PixelValue{is_on}, both);
    }
    for (unsigned bits = 0; bits < 64; ++bits) {
      const auto all = static_cast<std::uint8_t>(bits);
      expect_same(QuerySwitchesI{}, SwitchBits{all, 63, 0, 'I'}, both);
      expect_same(QuerySwitchesJ{},
                  SwitchBits{static_cast<std::uint8_t>(all & 48U), 48,
                             static_cast<std::uint8_t>(all & 15U), 'J'},
                  both);
      if (bits < 16) expect_same(QueryInputs{}, SwitchBits{0, 0, all, 'K'}, both);
    }
  }
}

TEST(ReplyDecoder, OfMark3TheByte32IsTakenForZero) {
  EXPECT_EQ(text_of_reply(QueryError{'E'}, " ", context(Profile::kMark3)), "E: 0 counts to go");
  EXPECT_EQ(text_of_reply(QueryError{'E'}, "\xa0", context(Profile::kPaper)),
            "E: 128 counts to go");
}

TEST(ReplyDecoder, NamesJointsWithoutAModel) {
  const ReplyContext paper = context(Profile::kPaper);
  EXPECT_EQ(text_of_reply(QuerySwitchesI{}, "$", paper), "microswitches closed: E");
  EXPECT_EQ(text_of_reply(QuerySwitchesI{}, "_", context(Profile::kMark3)),
            "no microswitch closed");
  EXPECT_EQ(text_of_reply(QuerySwitchesI{}, "_", paper), "microswitches closed: H, G, F, E, D, C");
  EXPECT_EQ(text_of_reply(QueryError{'E'}, "-", paper), "E: 13 counts to go");
}

TEST(ReplyDecoder, BytesThatAreNoReply) {
  const ReplyContext paper = context(Profile::kPaper, wire::PictureSize{10, 2});
  EXPECT_EQ(text_of_reply(QueryError{'E'}, "\x1f", paper), "no reply");
  EXPECT_EQ(text_of_reply(QueryError{'E'}, "\xa1", paper), "no reply");
  EXPECT_EQ(text_of_reply(QuerySwitch{'E'}, "\x02", paper), "no reply");
  EXPECT_EQ(text_of_reply(QuerySwitchesI{}, "`", paper), "no reply");
  EXPECT_EQ(text_of_reply(QueryInputs{}, "0", paper), "no reply");
  EXPECT_EQ(text_of_reply(CameraPixel{0, 0}, "\"", paper), "no reply");
  EXPECT_EQ(text_of_reply(CameraRow{0}, "\x7f ", paper), "no reply");
  EXPECT_EQ(text_of_reply(CameraRow{0}, "\\$", paper), "row 0 of the image: 10 pixels");
  EXPECT_EQ(text_of_reply(CameraImage{}, "\\$  ", paper), "image of 10 x 2 pixels");
}

TEST(ReplyDecoder, SizesOfReplies) {
  const ReplyContext unknown = context(Profile::kPaper);
  const ReplyContext known = context(Profile::kPaper, wire::PictureSize{10, 2});
  const ReplyContext none = context(Profile::kPaper, wire::PictureSize{});
  EXPECT_EQ(reply_size(QueryError{'E'}, unknown), 1U);
  EXPECT_EQ(reply_size(Move{'E', 5}, unknown), 0U);
  EXPECT_EQ(reply_size(ControllerReset{}, unknown), 0U);
  EXPECT_EQ(reply_size(CameraImage{}, unknown), std::nullopt);
  EXPECT_EQ(reply_size(CameraRow{0}, unknown), std::nullopt);
  EXPECT_EQ(reply_size(CameraPixel{0, 0}, unknown), 1U);
  EXPECT_EQ(reply_size(CameraImage{}, known), 4U);
  EXPECT_EQ(reply_size(CameraRow{1}, known), 2U);
  EXPECT_EQ(reply_size(CameraRow{2}, known), 0U);
  EXPECT_EQ(reply_size(CameraPixel{9, 1}, known), 1U);
  EXPECT_EQ(reply_size(CameraPixel{10, 1}, known), 0U);
  EXPECT_EQ(reply_size(CameraImage{}, none), 0U);
}

TEST(ReplyDecoder, TheContextOfAModel) {
  const ReplyContext rhino = context_of(*test::rhino());
  EXPECT_EQ(rhino.masks, (std::array<std::uint8_t, 8>{16, 32, 1, 2, 4, 8, 0, 0}));
  ASSERT_TRUE(rhino.camera);
  EXPECT_EQ(rhino.camera->width, 0);
}

}  // namespace
}  // namespace xr3

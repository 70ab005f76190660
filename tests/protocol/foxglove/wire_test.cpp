// The frames of the Foxglove WebSocket protocol: bytes to the client, and requests of the client.
#include "protocol/foxglove/wire.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/models.hpp"

namespace xr3::foxglove {
namespace {

using namespace std::string_literals;

TEST(FoxgloveWire, BinaryMessagesAreLittleEndian) {
  EXPECT_EQ(time_bytes(0x0102), "\x02\x02\x01\0\0\0\0\0\0"s);
  EXPECT_EQ(message_head(0x01020304, 5), "\x01\x04\x03\x02\x01\x05\0\0\0\0\0\0\0"s);
}

TEST(FoxgloveWire, AdvertisesEachTopicWithASchema) {
  const auto message = Json::parse(advertise_text(*test::rhino()));
  ASSERT_EQ(message["channels"].size(), kTopics);
  for (const Json& channel : message["channels"]) {
    const auto schema = Json::parse(channel["schema"].get<std::string>());
    EXPECT_EQ(schema["title"], channel["schemaName"]);
    EXPECT_EQ(channel["encoding"], "json");
    EXPECT_EQ(channel["schemaEncoding"], "jsonschema");
  }
  EXPECT_EQ(message["channels"][0]["id"], 1);
  EXPECT_EQ(message["channels"][0]["topic"], "/tf");
}

TEST(FoxgloveSubscriptions, BeginAndEnd) {
  Subscriptions all;
  const auto begun = all.carry_out(
      R"({"op":"subscribe","subscriptions":[{"id":70,"channelId":1},{"id":0,"channelId":6}]})");
  EXPECT_EQ(begun.complaint, "");
  EXPECT_EQ(begun.added, (std::vector{Topic::kTransforms, Topic::kState}));
  EXPECT_EQ(all.find(Topic::kTransforms), 70U);
  EXPECT_EQ(all.find(Topic::kState), 0U);
  EXPECT_EQ(all.find(Topic::kScene), std::nullopt);
  EXPECT_EQ(all.carry_out(R"({"op":"unsubscribe","subscriptionIds":[70]})").complaint, "");
  EXPECT_EQ(all.find(Topic::kTransforms), std::nullopt);
}

struct RefusedSubscription {
  const char* request;
  const char* complaint;  ///< a part of it
};
class FoxgloveRefusal : public testing::TestWithParam<RefusedSubscription> {};

TEST_P(FoxgloveRefusal, SaysWhatIsWrong) {
  Subscriptions all;
  all.carry_out(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":2}]})");
  const auto outcome = all.carry_out(GetParam().request);
  EXPECT_NE(outcome.complaint.find(GetParam().complaint), std::string::npos) << outcome.complaint;
  EXPECT_TRUE(outcome.added.empty());
  EXPECT_EQ(all.find(Topic::kScene), 9U);
}

INSTANTIATE_TEST_SUITE_P(
    All, FoxgloveRefusal,
    testing::Values(
        RefusedSubscription{"", "a message is a JSON object"},
        RefusedSubscription{"[1]", "a message is a JSON object"},
        RefusedSubscription{R"({"op":"subscribe"})", "a list subscriptions"},
        RefusedSubscription{R"({"op":"advertise","channels":[]})",
                            "op \"advertise\" is not carried out"},
        RefusedSubscription{"{}", "op nothing is not carried out"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[7]})",
                            "no channel nothing: they are 1 to 6"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":7}]})",
                            "no channel 7"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1.5}]})",
                            "channel 1.5"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
                            "is -1, but"},
        RefusedSubscription{
            R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})", "32 bits"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":1}]})",
                            "the id 9 has a subscription"},
        RefusedSubscription{R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})",
                            "channel 2 has a subscription"},
        RefusedSubscription{R"({"op":"unsubscribe","subscriptionIds":[8]})",
                            "no subscription with the id 8"},
        RefusedSubscription{R"({"op":"unsubscribe","subscriptionIds":[{}]})", "with the id {}"}));

TEST(FoxgloveSubscriptions, GoodPartsOfARequestAreCarriedOut) {
  Subscriptions all;
  const auto outcome = all.carry_out(
      R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99},{"id":2,"channelId":3}]})");
  EXPECT_NE(outcome.complaint, "");
  EXPECT_EQ(outcome.added, (std::vector{Topic::kBlocks}));
}

}  // namespace
}  // namespace xr3::foxglove

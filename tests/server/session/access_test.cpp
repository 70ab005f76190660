// Access rules with and without a token.
#include "server/session/access.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

constexpr const char* kToken = "sixteen letters!";

TEST(Access, WithoutATokenNoTokenIsNeededOrRight) {
  const AccessPolicy policy;
  EXPECT_FALSE(policy.needs_token());
  EXPECT_FALSE(policy.is_private());
  EXPECT_FALSE(policy.is_right(""));
  EXPECT_FALSE(policy.is_right(kToken));
}

TEST(Access, AcceptsOnlyTheCompleteToken) {
  const AccessPolicy policy({{}, ReadAccess::kFree, kToken});
  EXPECT_TRUE(policy.needs_token());
  EXPECT_FALSE(policy.is_private());
  EXPECT_TRUE(policy.is_right(kToken));
  for (const char* wrong : {"", "sixteen letters", "sixteen letters!!", "Sixteen letters!"})
    EXPECT_FALSE(policy.is_right(wrong)) << wrong;
}

TEST(Access, IsPrivateOnlyWithAToken) {
  EXPECT_TRUE(AccessPolicy({{}, ReadAccess::kWithToken, kToken}).is_private());
  EXPECT_FALSE(AccessPolicy({{}, ReadAccess::kWithToken, ""}).is_private());
}

TEST(Access, TheTokenOfTheMetricsIsForThemAlone) {
  constexpr const char* kOfMetrics = "of the metrics only";
  const AccessPolicy policy({{}, ReadAccess::kWithToken, kToken, kOfMetrics});
  EXPECT_TRUE(policy.has_metrics_token());
  EXPECT_TRUE(policy.is_right_for_metrics(kOfMetrics));
  EXPECT_FALSE(policy.is_right_for_metrics(kToken));
  EXPECT_FALSE(policy.is_right(kOfMetrics));
  EXPECT_FALSE(AccessPolicy({{}, ReadAccess::kWithToken, kToken}).is_right_for_metrics(""));
}

TEST(Access, AppliesTheRulesForHostsAndOrigins) {
  const AccessPolicy policy({{http::HostReach::kBeyond, {}, {"https://a.example"}}, {}, ""});
  EXPECT_TRUE(policy.is_host_allowed("xr3:9601"));
  EXPECT_TRUE(policy.is_origin_allowed("https://a.example", "xr3:9601"));
  EXPECT_FALSE(AccessPolicy().is_host_allowed("xr3:9601"));
}

}  // namespace
}  // namespace xr3

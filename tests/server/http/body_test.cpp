#include "server/http/body.hpp"

#include <gtest/gtest.h>

namespace xr3::http {
namespace {

TEST(HttpBody, CopiesShareTheBytes) {
  const Body body(std::string(100, 'x'));
  EXPECT_EQ(body.share_bytes(), 100U);
  {
    const Body copy = body;
    EXPECT_EQ(copy.bytes().data(), body.bytes().data());
    EXPECT_EQ(body.share_bytes(), 50U);
  }
  EXPECT_EQ(body.share_bytes(), 100U);
}

TEST(HttpBody, StaticBytesBelongToNobody) {
  EXPECT_EQ(Body::of_static("ok\n").bytes(), "ok\n");
  EXPECT_EQ(Body::of_static("ok\n").share_bytes(), 0U);
  EXPECT_EQ(Body().share_bytes(), 0U);
}

}  // namespace
}  // namespace xr3::http

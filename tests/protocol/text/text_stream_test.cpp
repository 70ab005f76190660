#include "protocol/text/text_stream.hpp"

#include <gtest/gtest.h>

#include <new>

#include "tests/support/allocations.hpp"

namespace xr3 {
namespace {

TEST(TextStream, MakesAText) {
  TextStream stream;
  stream << "a number: " << 1.5;
  EXPECT_EQ(stream.str(), "a number: 1.5");
}

TEST(TextStream, ThrowsIfMemoryEnds) {
  TextStream stream;
  const test::NoMemory none;
  EXPECT_THROW(stream << "a text that needs an allocation", std::bad_alloc);
}

}  // namespace
}  // namespace xr3

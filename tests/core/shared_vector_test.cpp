#include "core/shared_vector.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3 {
namespace {

using Texts = SharedVector<std::string>;

TEST(SharedVector, CopiesShareUntilOneChanges) {
  Texts first = {"a", "b"};
  const std::string* const before = &first[0];
  Texts second = first;
  EXPECT_TRUE(second.is_shared_with(first));
  EXPECT_EQ(&second[0], before);

  second.edit()[1] = "c";
  EXPECT_FALSE(second.is_shared_with(first));
  EXPECT_EQ(first, (Texts{"a", "b"}));
  EXPECT_EQ(second, (Texts{"a", "c"}));
  EXPECT_EQ(&first[0], before);
}

TEST(SharedVector, TheOnlyOwnerChangesItsValuesInPlace) {
  Texts texts = {"a", "b"};
  const std::string* const before = &texts[0];
  texts.edit()[0] = "c";
  EXPECT_EQ(&texts[0], before);

  const Texts copy = std::exchange(texts, {});
  EXPECT_EQ(copy, (Texts{"c", "b"}));
}

TEST(SharedVector, EqualValuesAreEqualThoughNotShared) {
  const Texts first = {"a"};
  const Texts second = {"a"};
  EXPECT_FALSE(first.is_shared_with(second));
  EXPECT_EQ(first, second);
  EXPECT_NE(first, (Texts{"a", "a"}));
}

TEST(SharedVector, AnEmptyOneHasNoValuesToShare) {
  Texts empty;
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(empty.begin(), empty.end());
  EXPECT_TRUE(empty.is_shared_with(std::vector<std::string>()));
  Texts copy = empty;
  copy.edit().push_back("a");
  EXPECT_EQ(copy.size(), 1U);
  EXPECT_TRUE(empty.empty());
  copy.edit().clear();
  EXPECT_EQ(copy, empty);
}

}  // namespace
}  // namespace xr3

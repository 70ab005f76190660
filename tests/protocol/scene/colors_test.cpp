// The colours of solids are those of the page.
#include "protocol/scene/colors.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "core/drawing/palette.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

std::vector<std::string> colors_of_the_page() {
  const std::string file = test::project_file("clients/web/src/lib/palette.js");
  const std::string list = file.substr(0, file.find("];"));
  const std::regex color("#[0-9a-f]{6}");
  std::vector<std::string> colors;
  for (std::sregex_iterator at(list.begin(), list.end(), color), end; at != end; ++at)
    colors.push_back(at->str());
  return colors;
}

TEST(SolidColors, AreThoseOfThePage) {
  const std::vector<std::string> page = colors_of_the_page();
  ASSERT_EQ(page.size(), static_cast<std::size_t>(kColors));
  for (int i = 0; i < kColors; ++i) {
    const auto [red, green, blue] = solid_rgb(i);
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    EXPECT_EQ(text, page[static_cast<std::size_t>(i)]);
  }
}

}  // namespace
}  // namespace xr3

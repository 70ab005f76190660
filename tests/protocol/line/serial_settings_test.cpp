// The settings of a serial port and their text form.
#include "protocol/line/serial_settings.hpp"

#include <gtest/gtest.h>

namespace xr3 {
namespace {

TEST(SerialSettings, HaveATextFormThatIsReadBack) {
  for (const std::string text :
       {"9600-7e2", "9600-8n1", "1200-7o1", "115200-8n1-rtscts", "300-5n1.5", "9600-8m1-xonxoff",
        "4294967295-6s2", "1-8n1", "38400"}) {
    const auto settings = parse_serial_settings(text);
    ASSERT_TRUE(settings) << text;
    EXPECT_EQ(text_of(*settings), text);
  }
}

TEST(SerialSettings, AreThoseOfTheMarkThreeByDefault) {
  EXPECT_EQ(text_of({kDefaultBaud, SerialFrame{}}), "9600-7e2");
}

TEST(SerialSettings, AcceptLettersInEitherCase) {
  EXPECT_EQ(parse_serial_settings("9600-7E2"), (SerialSettings{9600, SerialFrame{}}));
}

TEST(SerialSettings, RefuseOtherTexts) {
  for (const char* text : {"",
                           "0",
                           "-1",
                           "+9600",
                           "9600-",
                           "9600-7",
                           "9600-7e",
                           "9600-7e3",
                           "9600-9n1",
                           "9600-4n1",
                           "9600-7x2",
                           "9600-7e2-",
                           "9600-7e2-none",
                           "9600-7e1.50",
                           "9600 7e2",
                           " 9600",
                           "9600-7e2 ",
                           "4294967296",
                           "9600-7e2-rtscts-rtscts",
                           "9600-\x7f"
                           "e2"}) {
    EXPECT_FALSE(parse_serial_settings(text)) << text;
  }
}

}  // namespace
}  // namespace xr3

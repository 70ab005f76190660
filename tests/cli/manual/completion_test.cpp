#include "cli/manual/completion.hpp"

#include <gmock/gmock.h>

#include "cli/manual/man_page.hpp"

namespace xr3 {
namespace {

using ::testing::HasSubstr;

DescribedOption option_of(const std::string& name, const std::string& type,
                          const std::string& description = "what it is") {
  DescribedOption option;
  option.name = name;
  option.type = type;
  option.description = description;
  return option;
}

DescribedProgram program_with(const DescribedOption& option) {
  return {"xr3",
          "1.2.3",
          "A robot.",
          "Exit codes: 0 success.",
          {option_of("--version", "")},
          {{"serve", "start it", {option}}}};
}

TEST(ValueChoices, AreTheWordsOfTheType) {
  EXPECT_EQ((ValueChoices{{"paper", "mark3"}, "", false}),
            choices_of(option_of("--compat", "paper|mark3")));
  EXPECT_EQ((ValueChoices{{"real", "manual", "bytes"}, "", false}),
            choices_of(option_of("--clock", "real[:FACTOR]|manual|bytes[:MS[,settle=MS]]")));
}

TEST(ValueChoices, AreFilesForTypesThatAreFiles) {
  for (const char* type : {"FILE", "FOLDER", "OUT.svg|OUT.png", "DEVICE[:9600-7e2]", "NEW.json"})
    EXPECT_EQ((ValueChoices{{}, "", true}), choices_of(option_of("--any", type))) << type;
}

TEST(ValueChoices, AreNamesAndFilesForDataFiles) {
  EXPECT_EQ((ValueChoices{{}, "robots", true}), choices_of(option_of("--robot", "NAME|FILE")));
  EXPECT_EQ((ValueChoices{{}, "workcells", true}), choices_of(option_of("--from", "NAME|FILE")));
  EXPECT_EQ((ValueChoices{{}, "exercises", true}),
            choices_of(option_of("--exercise", "NAME|FOLDER|ZIP")));
  EXPECT_EQ((ValueChoices{{}, "faults", true}), choices_of(option_of("--fault", "NAME|FILE")));
}

TEST(ValueChoices, AreNoneForNumbersAndFlags) {
  EXPECT_EQ(ValueChoices{}, choices_of(option_of("--max-lines", "N")));
  EXPECT_EQ(ValueChoices{}, choices_of(option_of("--private", "")));
}

TEST(BashCompletion, HasACaseForEachValue) {
  const std::string text = bash_completion(program_with(option_of("--compat", "paper|mark3")));
  EXPECT_THAT(text, HasSubstr("    serve,--compat) words='paper mark3' ;;\n"
                              "    serve,*) words='--compat' ;;\n"
                              "    ,*) words='serve --version' ;;\n"));
}

TEST(ZshCompletion, EscapesWhatZshReads) {
  const std::string text =
      zsh_completion(program_with(option_of("--at", "H:M", "time [h:m], the arm's")));
  EXPECT_THAT(text, HasSubstr("'--at=[time \\[h\\:m\\], the arm'\\''s]:H\\:M: '"));
}

TEST(ZshCompletion, GivesTheFlagsOfArgumentsFirst) {
  EXPECT_THAT(zsh_completion(program_with(option_of("--x", ""))),
              HasSubstr("  _arguments -s -C \\\n    '--version[what it is]'"));
}

TEST(FishCompletion, HasALineForEachOption) {
  const std::string text = fish_completion(program_with(option_of("--robot", "NAME|FILE")));
  EXPECT_THAT(text,
              HasSubstr("complete -c xr3 -n '__fish_seen_subcommand_from serve' -l robot -r -F"
                        " -a '(xr3 completion robots 2>/dev/null)' -d 'what it is'\n"));
}

TEST(ManPage, OfACommandHasItsOptions) {
  DescribedOption port = option_of("--port", "PORT", "the port; -1 is none");
  port.default_value = "9600";
  port.environment = "XR3_PORT";
  const DescribedProgram program = program_with(port);
  const std::string page = man_page(program, program.commands[0]);
  EXPECT_THAT(page, HasSubstr(".TH XR3\\-SERVE 1 \"\" \"xr3 1.2.3\""));
  EXPECT_THAT(page, HasSubstr(".TP\n\\fB\\-\\-port\\fR \\fIPORT\\fR\nthe port; \\-1 is none.\n"
                              "Default: 9600.\nEnvironment: \\fBXR3_PORT\\fR.\n"));
}

TEST(ManPage, TakesNoLineForARequest) {
  DescribedProgram program = program_with(option_of("--x", "", "first\n.so /etc/passwd\n'x"));
  const std::string page = man_page(program, program.commands[0]);
  EXPECT_THAT(page, HasSubstr("first\n\\&.so /etc/passwd\n\\&'x."));
}

TEST(ManPage, TakesItsNameLineFromTheDescription) {
  DescribedProgram program = program_with(option_of("--x", ""));
  program.description = "xr3: a robot.\nIt has more to say.";
  EXPECT_THAT(man_page(program), HasSubstr(".SH NAME\nxr3 \\- a robot\n"));
}

TEST(ManPage, OfTheProgramListsTheCommands) {
  EXPECT_THAT(man_page(program_with(option_of("--x", ""))),
              HasSubstr(".TP\n\\fBxr3\\-serve\\fR(1)\nstart it.\n"));
}

}  // namespace
}  // namespace xr3

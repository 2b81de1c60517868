// What shells and man know of the program: completion that a shell executes, pages for every command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

// bash, with the script that the program prints, proposes commands, options, their values, and scenes.
TEST(Completion, WorksInBash) {
  const Sandbox sandbox;
  const auto complete = [&](const std::string& words) {
    return sandbox.RunScript("penumbra completion bash > c.bash; bash -c 'source c.bash; COMP_WORDS=(" +
                             words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _penumbra; echo ${COMPREPLY[*]}'");
  };
  EXPECT_EQ(complete("penumbra form").out, "form-factor\n");
  EXPECT_EQ(complete("penumbra probe --poi").out, "--points\n");
  EXPECT_EQ(complete("penumbra solve --refine re").out, "representation\n");
  EXPECT_EQ(complete("penumbra info offi").out, "office\n");
  EXPECT_EQ(complete("penumbra info --no-such").out, "\n");
  sandbox.Write("offices.obj", "");
  EXPECT_EQ(complete("penumbra info offi").out, "office offices.obj\n");
  EXPECT_EQ(complete("penumbra info").err, "");
}

// The script for zsh names every command; another shell is refused.
TEST(Completion, IsPrintedForZsh) {
  const Sandbox sandbox;
  const Outcome zsh = sandbox.Run({"completion", "zsh"});
  EXPECT_EQ(zsh.status, 0);
  EXPECT_EQ(Lines(zsh.out)[0], "#compdef penumbra");
  for (const char* word :
       {"'solve:", "    form-factor)", "'--refine[", ":value:(transport representation both)"})
    EXPECT_THAT(zsh.out, HasSubstr(word));
  const Outcome checked = sandbox.RunScript(
      "penumbra completion zsh > _penumbra; if command -v zsh > /dev/null; then zsh -n _penumbra; fi");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_EQ(sandbox.Run({"completion", "fish"}).status, 2);
}

// Every command has a page, which names every option of its help; roff takes no word for a request.
TEST(ManualPages, NameEveryOption) {
  const Sandbox sandbox;
  const Outcome written = sandbox.RunScript("mkdir man && penumbra manual-page --folder man && ls man");
  ASSERT_EQ(written.status, 0) << written.err;
  EXPECT_THAT(Lines(written.out), testing::Contains("penumbra-form-factor.1"));
  for (const std::string& file : Lines(written.out)) {
    const std::string page = ReadBytes(sandbox.Path("man/" + file));
    EXPECT_THAT(page, testing::StartsWith(".TH PENUMBRA"));
    for (const std::string& line : Lines(page))
      if (line.starts_with(".")) {
        EXPECT_THAT(line, testing::MatchesRegex("\\.(TH|SH|SS|TP|nf|fi)( .*)?"));
      }
  }
  const Outcome solve = sandbox.Run({"manual-page", "solve"});
  for (const char* option : {"\\-\\-error", "\\-\\-eps", "\\-\\-oracle\\fR thesis", "\\-\\-report"})
    EXPECT_THAT(solve.out, HasSubstr(option));
  const Outcome set = sandbox.RunScript(
      "if command -v groff > /dev/null; then penumbra manual-page solve | groff -man -ww -Tutf8 > /dev/null; "
      "fi");
  EXPECT_EQ(set.err, "");
  EXPECT_EQ(sandbox.Run({"manual-page", "rendr"}).status, 2);
}

}  // namespace
}  // namespace penumbra

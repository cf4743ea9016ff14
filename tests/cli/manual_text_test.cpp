// Pages of the manual and completion, to the letter, of commands made up here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/cli/manual/completion.hpp"
#include "vantage/cli/manual/man_page.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
using testing::HasSubstr;
using testing::Not;

CommandText made_up_run() {
  CommandText run{.name = "run", .text = "runs a file", .footer = "as in:\n  run x"};
  run.options = {
      {.names = {"-q", "--quiet"}, .text = "print less"},
      {.names = {"--out-dir"}, .text = "folder", .takes_value = true, .required = true},
      {.names = {"episode"},
       .text = "its file",
       .default_value = "a.yaml",
       .positional = true,
       .takes_value = true},
      {.names = {"--set"}, .text = "key=value of it", .takes_value = true, .repeats = true},
      {.names = {"more"},
       .text = "others",
       .positional = true,
       .takes_value = true,
       .required = true,
       .repeats = true}};
  return run;
}

CommandText made_up_sweep() {
  CommandText sweep{.name = "sweep", .text = "studies"};
  sweep.parts = {{.name = "sweep run", .text = "runs one"}};
  return sweep;
}

const ManualFrame kFrame{"1.2-3", "flies and looks", {{"0", "done"}, {"2", "wrong use"}}};

TEST(RoffText, PrintsEverySignAsItIs) {
  EXPECT_EQ(roff_text("a-b 'c' `d` ^~ \\e"), "a\\-b \\(aqc\\(aq \\(gad\\(ga \\(ha\\(ti \\ee");
  EXPECT_EQ(roff_text(".a\n.b.c\n'd"), "\\&.a\n\\&.b.c\n\\&\\(aqd");
}

TEST(ManualPages, OfACommandSayHowItIsUsed) {
  EXPECT_EQ(command_page(made_up_run(), kFrame),
            ".TH \"VANTAGE-RUN\" \"1\" \"\" \"vantage 1.2\\-3\" \"User Commands\"\n"
            ".SH NAME\nvantage\\-run \\- runs a file\n"
            ".SH SYNOPSIS\n.PP\n"
            ".B vantage run \\-\\-out\\-dir OUT\\-DIR [OPTIONS] [episode] more ...\n"
            ".SH OPTIONS\n"
            ".TP\n\\fBepisode\\fR\nits file (default: a.yaml)\n"
            ".TP\n\\fBmore\\fR\nothers\n"
            ".TP\n\\fB\\-q, \\-\\-quiet\\fR\nprint less\n"
            ".TP\n\\fB\\-\\-out\\-dir OUT\\-DIR\\fR\nfolder (required)\n"
            ".TP\n\\fB\\-\\-set key=value\\fR\nkey=value of it\n"
            ".SH NOTES\n.PP\n.nf\nas in:\n  run x\n.fi\n"
            ".SH EXIT STATUS\n.TP\n\\fB0\\fR\ndone\n.TP\n\\fB2\\fR\nwrong use\n"
            ".SH SEE ALSO\n\\fBvantage\\fR(1)\n");
}

TEST(ManualPages, OfACommandWithPartsHaveThemInstead) {
  const std::string page = command_page(made_up_sweep(), kFrame);
  EXPECT_THAT(page, HasSubstr(".SH SYNOPSIS\n.PP\n.B vantage sweep run [OPTIONS]\n"
                              ".SH COMMANDS\n.SS \"vantage sweep run\"\n"
                              ".PP\n.B vantage sweep run [OPTIONS]\n.PP\nruns one\n"
                              ".SH EXIT STATUS\n"));
  EXPECT_THAT(page, Not(HasSubstr(".SH OPTIONS")));
  EXPECT_THAT(page, Not(HasSubstr(".SH NOTES")));
}

TEST(ManualPages, AreAFileACommandAndOneOfAll) {
  const support::TemporaryDirectory folder;
  write_manual({made_up_run(), made_up_sweep()}, kFrame, folder / "man");
  EXPECT_EQ(read_file(folder / "man/vantage-run.1"), command_page(made_up_run(), kFrame));
  EXPECT_EQ(read_file(folder / "man/vantage-sweep.1"), command_page(made_up_sweep(), kFrame));
  const std::string all = read_file(folder / "man/vantage.1");
  EXPECT_EQ(all, program_page({made_up_run(), made_up_sweep()}, kFrame));
  EXPECT_THAT(all, HasSubstr(".SH NAME\nvantage \\- flies and looks\n"));
  EXPECT_THAT(all, HasSubstr(".SH COMMANDS\n.TP\n\\fBrun\\fR\nruns a file\n"
                             ".TP\n\\fBsweep\\fR\nstudies\n.SH OPTIONS\n"));
  EXPECT_THAT(all, testing::EndsWith("\\fBvantage\\-run\\fR(1), \\fBvantage\\-sweep\\fR(1)\n"));
}

TEST(CompletionScript, OffersCommandsFlagsWordsAndValues) {
  const std::vector<KeyDescription> keys{{.key = "gain", .type = "one of x, y"},
                                         {.key = "gain", .type = "one of w, x, or null"},
                                         {.key = "flag", .type = "true or false"},
                                         {.key = "other", .type = "number"},
                                         {.key = "list[]", .type = "number"}};
  const std::string script = bash_completion(
      {made_up_run(), made_up_sweep()}, {{"run", "--gain", {"b", "a"}}, {"", "--jobs", {}}}, keys);
  EXPECT_THAT(script, HasSubstr("_vantage_parts() {\n  case \"$1\" in\n"
                                "    \"\") echo \"run sweep\" ;;\n    \"sweep\") echo \"run\" ;;\n"
                                "\n  esac"));
  EXPECT_THAT(script, HasSubstr("    \"\") echo \"--help --version\" ;;\n"
                                "    \"run\") echo \"-q --quiet --out-dir --set\" ;;\n\n"));
  EXPECT_THAT(script, HasSubstr("    \"run --gain\") echo \"b a\" ;;\n\n"));
  EXPECT_THAT(script, HasSubstr("    \"flag\") echo \"false true\" ;;\n"
                                "    \"gain\") echo \"w x y\" ;;\n\n"));
  EXPECT_THAT(script, HasSubstr("_vantage_keys=\"flag gain other\"\n"));
  EXPECT_THAT(script, Not(HasSubstr("--jobs")));
}

}  // namespace
}  // namespace vantage

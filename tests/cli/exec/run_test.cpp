// Runs of shell scripts as programs under test, with real processes and pseudo-terminals.
#include "cli/exec/run.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <string>
#include <utility>

#include "tests/support/models.hpp"

namespace xr3 {
namespace {

// Moves motor E by 20 counts, over the pseudo-terminal of the run.
const std::string kMove = R"(printf 'E+20\r' >"$XR3_PTY"; )";

Goal motor_e_at(Counts count) {
  goal::JointValue value;
  value.label = 'E';
  value.count = count;
  return {.body = value};
}

class RunTest : public testing::Test {
 protected:
  RunTest() {
    settings_.seed.model = test::rhino();
    settings_.exec.is_quiet = true;
  }

  RunReport run(const std::string& script) {
    settings_.exec.command = {"/bin/sh", "-c", script};
    GoalList goals;
    goals.goals.push_back(motor_e_at(20));
    return run_program(settings_, goals).report;
  }

  RunSettings settings_;
};

TEST_F(RunTest, AProgramThatMeetsItsGoalsPasses) {
  const RunReport report = run(kMove);
  EXPECT_EQ(report.outcome, RunOutcome::kFinished) << report.why;
  EXPECT_TRUE(report.is_passed());
  EXPECT_EQ(report.bytes, 5U);
}

TEST_F(RunTest, AProgramThatNeverReachesTheRobotIsTold) {
  const RunReport report = run("true");
  EXPECT_EQ(report.outcome, RunOutcome::kFinished);
  EXPECT_FALSE(report.is_passed());
  EXPECT_EQ(report.why, "nothing reached this run's robot: use XR3_HOST and XR3_PORT");
}

TEST_F(RunTest, AProgramThatEndsWithAnErrorFailsAndItsErrorsAreKept) {
  const RunReport report = run(kMove + "echo no robot >&2; exit 3");
  EXPECT_EQ(report.outcome, RunOutcome::kFailed);
  EXPECT_EQ(report.why, "the program ended with exit code 3");
  EXPECT_EQ(report.errors, "no robot\n");
  EXPECT_FALSE(report.is_passed());
}

TEST_F(RunTest, ASignalThatEndsAProgramIsNamed) {
  EXPECT_EQ(run(kMove + "kill -SEGV $$").why,
            "the program ended with signal 11 (Segmentation fault)");
}

TEST_F(RunTest, AMissingProgramIsNamed) {
  settings_.exec.command = {"/no/such/program"};
  const RunReport report = run_program(settings_, {}).report;
  EXPECT_EQ(report.outcome, RunOutcome::kFailed);
  EXPECT_EQ(report.why, "/no/such/program cannot be started: No such file or directory");
}

TEST_F(RunTest, ARefusedProgramIsNotStarted) {
  settings_.refused = "no executable file";
  EXPECT_EQ(run(kMove).why, "no executable file");
}

TEST_F(RunTest, TheWallTimeIsLimited) {
  settings_.exec.limits.wall_s = 0.1;
  const RunReport report = run(kMove + "sleep 600");
  EXPECT_EQ(report.outcome, RunOutcome::kTimeUp);
  EXPECT_EQ(report.why, "the program still ran after 0.1 seconds (--max-seconds)");
}

TEST_F(RunTest, TheSimulatedTimeIsLimited) {
  settings_.exec.limits.sim_ticks = 3;
  const RunReport report = run(kMove + "sleep 600");
  EXPECT_EQ(report.outcome, RunOutcome::kTimeUp);
  EXPECT_NE(report.why.find("(--max-sim-seconds)"), std::string::npos) << report.why;
  EXPECT_EQ(report.ticks, 3);
}

TEST_F(RunTest, TheNumberOfBytesIsLimited) {
  settings_.exec.limits.bytes = 4;
  EXPECT_EQ(run(kMove + "sleep 600").why, "the program sent more than 4 bytes (--max-bytes)");
}

TEST_F(RunTest, TheNumberOfProcessesIsLimited) {
  settings_.exec.limits.processes = 2;
  EXPECT_EQ(run(kMove + "sleep 600 & sleep 600 & wait").why,
            "the program had more than 2 processes (--processes)");
}

TEST_F(RunTest, ProcessesThatTheProgramLeavesBehindAreEnded) {
  EXPECT_TRUE(run(kMove + "setsid sleep 600 & sleep 600 &").is_passed());
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace xr3
